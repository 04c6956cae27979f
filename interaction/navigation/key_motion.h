// Motion through keys: numbers, positions, turns and similarities, without jumps of their speed.
#pragma once

#include "interaction/pose.h"

#include <cstddef>
#include <vector>

namespace isochron::interaction {

/// When a film comes to a key, and how it goes on.
struct KeyTime {
    double arrives = 0, leaves = 0; ///< [s]
    bool even = false;              ///< numbers go on at one rate
};

/// A place on the way: behind a key, or at it.
struct KeyPlace {
    std::size_t key = 0;
    double share = 0; ///< elapsed part of the move to the next key, 0 to 1; 0: at rest
};

/// The times of the keys that hold one setting.
struct KeyTimes {
    std::vector<KeyTime> at; ///< ascending, not empty
    bool closed = false;     ///< the last key is the first one again

    KeyPlace place(double time) const;
    double lasts(std::size_t move) const { return at[move + 1].arrives - at[move].leaves; }
    bool rests(std::size_t key) const; ///< nothing moves at this key
};

/// A number that goes through its values at the keys, and never leaves the range of two neighbors.
class KeyedNumber {
  public:
    /// @param even whether it goes at one rate where the times say so
    /// @param growth of each move: logarithm of the scale's growth that the number follows, so that
    /// it stays in proportion to a scale that grows geometrically; empty: no scale
    KeyedNumber(const KeyTimes& times, std::vector<double> values, bool even = false,
                std::vector<double> growth = {});
    double at(const KeyPlace& place) const;

  private:
    struct Move {
        double growth = 0;
        double first = 0, last = 0; ///< slopes at its ends, in multiples of the even pace, 0 to 3
    };
    std::vector<double> values_;
    std::vector<Move> moves_;
};

/// An orientation that turns the shortest way from key to key.
class KeyedTurn {
  public:
    KeyedTurn(const KeyTimes& times, std::vector<glm::dquat> values);
    glm::dquat at(const KeyPlace& place) const;

  private:
    struct Move {
        glm::dvec3 turn{0.0};             ///< rotation vector of the whole move [rad]
        glm::dvec3 first{0.0}, last{0.0}; ///< derivatives of the rotation vector by the share
    };
    std::vector<glm::dquat> values_;
    std::vector<Move> moves_;
};

/// A place of the room, along three axes.
class KeyedPosition {
  public:
    KeyedPosition(const KeyTimes& times, const std::vector<glm::dvec3>& values,
                  const std::vector<double>& growth = {});
    glm::dvec3 at(const KeyPlace& place) const;

  private:
    std::vector<KeyedNumber> axes_;
};

/// Where the data stand.
class KeyedSimilarity {
  public:
    /// @param pivot place of the data, physical space, near which they turn if nothing says where
    KeyedSimilarity(const KeyTimes& times, std::vector<Similarity> values, const glm::dvec3& pivot);
    Similarity at(const KeyPlace& place) const;

  private:
    std::vector<Similarity> values_;
    glm::dvec3 center_;      ///< that moves least, physical space with heights exaggerated
    KeyedPosition position_; ///< the center's
    KeyedTurn turn_;
    KeyedNumber scale_, exaggeration_; ///< logarithms
};

} // namespace isochron::interaction
