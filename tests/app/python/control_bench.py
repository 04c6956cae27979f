"""What steering a session costs: from a command to the frame that shows it, less that frame; frames under a flood.

    xvfb-run python3 tests/app/python/control_bench.py run.isochron --isovalue 0.5 --json out.json
"""

import argparse
import json
import os
import select
import socket
import statistics
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
RATE = 10_000  # commands a second

FLOOD = """
import socket, sys, threading, time
link = socket.socket(socket.AF_UNIX)
link.connect(sys.argv[1])
def drain():
    while link.recv(1 << 16):
        pass
threading.Thread(target=drain, daemon=True).start()
lines = b'{"verb": "commands", "commands": {"grid": false}}\\n' * 100
sent, begun, rate = 0, time.time(), int(sys.argv[3])
while time.time() < begun + float(sys.argv[2]):
    link.sendall(lines)
    sent += 100
    time.sleep(max(0, begun + sent / rate - time.time()))
print(sent / (time.time() - begun))
"""


class Link:
    """Lines of JSON over the control socket."""

    def __init__(self, path):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(path)
        self.lines = self.socket.makefile("rb")

    def read(self):
        return json.loads(self.lines.readline())

    def ask(self, **request):
        self.socket.sendall(json.dumps(request).encode() + b"\n")
        while "ok" not in (answer := self.read()):
            pass
        assert answer["ok"], answer
        return answer

    def skip_until_still(self, seconds):
        """Skips what is told of frames, until none comes for so long: then nothing is drawn."""
        while select.select([self.socket], [], [], seconds)[0]:
            self.read()

    def tell(self, **commands):
        return self.ask(verb="commands", commands=commands)["frame"]


def watching(path):
    link = Link(path)
    link.ask(verb="subscribe", to=["statistics"], rate=120)
    return link


def frame_times(link, seconds):
    times, end = [], time.time() + seconds
    while time.time() < end:
        if "event" in (event := link.read()):
            times.append(event["statistics"]["total_ms"])
    return times


def over_the_frame(teller, watcher, count):
    """Of commands to a session at rest: answered less the time of the frame that shows it, and answered. [ms]"""
    over, whole = [], []
    for i in range(count):
        watcher.skip_until_still(0.3)
        begun = time.perf_counter()
        frame = teller.tell(step=i % 2)
        passed = 1e3 * (time.perf_counter() - begun)
        while (event := watcher.read())["frame"] < frame:
            pass
        if event["frame"] == frame:
            over.append(passed - event["statistics"]["total_ms"])
            whole.append(passed)
    return over, whole


def measure(path, rounds, seconds, count):
    teller, watcher = Link(path), watching(path)
    playback = {"reverse": False, "loop": True, "speed": 1}
    teller.tell(playback={"playing": True} | playback)
    quiet, flooded, sent = [], [], []
    for _ in range(rounds):  # in turn
        quiet += frame_times(watcher, seconds)
        flood = subprocess.Popen([sys.executable, "-c", FLOOD, path, str(seconds + 0.5), str(RATE)], stdout=subprocess.PIPE)
        flooded += frame_times(watcher, seconds)
        sent.append(float(flood.communicate()[0]))
    teller.tell(playback={"playing": False} | playback)
    time.sleep(1)
    over, whole = over_the_frame(teller, watching(path), count)
    teller.ask(verb="commands", commands={"quit": True})
    medians = [statistics.median(times) for times in (quiet, flooded)]
    return {"load": os.getloadavg()[0], "commands_per_s": statistics.mean(sent), "frame_ms": medians[0],
            "frame_ms_flooded": medians[1], "ratio": medians[1] / medians[0], "told": len(over),
            "over_frame_ms": statistics.median(over), "over_frame_ms_p90": sorted(over)[int(len(over) * 0.9)],
            "command_to_frame_ms": statistics.median(whole)}


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("index")
    options.add_argument("--isovalue", required=True)
    options.add_argument("--program", default=os.path.join(HERE, "../../../build/release/isochron"))
    options.add_argument("--rounds", type=int, default=4)
    options.add_argument("--seconds", type=float, default=4)
    options.add_argument("--commands", type=int, default=100)
    options.add_argument("--json", help="also write the figures there")
    asked = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "control.sock")
        session = subprocess.Popen([asked.program, "explore", asked.index, "--isovalue", asked.isovalue, "--control", path],
                                   cwd=folder, stderr=subprocess.DEVNULL,
                                   env=os.environ | {name: folder for name in ("XDG_STATE_HOME", "XDG_CONFIG_HOME")})
        try:
            while not os.path.exists(path) and session.poll() is None:
                time.sleep(0.05)
            found = measure(path, asked.rounds, asked.seconds, asked.commands)
            session.wait(timeout=60)
        finally:
            session.kill()
    print(f"load {found['load']:.1f}; {found['commands_per_s']:.0f} commands a second: frames {found['frame_ms']:.2f} -> "
          f"{found['frame_ms_flooded']:.2f} ms, ratio {found['ratio']:.2f}; a command to its frame beyond that frame: median "
          f"{found['over_frame_ms']:.2f} ms, p90 {found['over_frame_ms_p90']:.2f} ms of {found['told']}")
    if asked.json:
        with open(asked.json, "w", encoding="utf-8") as out:
            json.dump(found, out, indent=1)


if __name__ == "__main__":
    main()
