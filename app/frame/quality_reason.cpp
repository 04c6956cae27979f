// The names of the reasons for a footprint.
#include "app/frame/quality_reason.h"

namespace isochron::app {

const char* name_of(QualityReason reason) {
    switch (reason) {
    case QualityReason::moving: return "moving";
    case QualityReason::fast_mode: return "fast mode";
    case QualityReason::quality_mode: return "quality mode";
    case QualityReason::paper_mode: return "paper mode";
    case QualityReason::configured: return "configured";
    case QualityReason::fits: return "fits";
    case QualityReason::trial: return "trial";
    case QualityReason::in_parts: return "in parts";
    case QualityReason::over_budget: break;
    }
    return "over budget";
}

} // namespace isochron::app
