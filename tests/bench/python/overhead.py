"""How much longer a batch takes from Python than from C++: both are asked in turn, on one thread,
and medians of the time are compared that the thread was running for.

    overhead.py SERVER [ROUNDS]        SERVER: python_batch_server

Prints a table, and lines `ratio python.KIND.COUNT VALUE`: the time from Python by that from C++, by which 1 is no
overhead. Fails where the number of hits differs.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import pierce

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
from meshes import random_segments, sphere  # noqa: E402

COUNTS = (100_000, 1_000_000)


def main() -> int:
    server, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 21
    vertices, faces = sphere(160)
    starts, ends = random_segments(max(COUNTS))
    mesh = pierce.CollisionMesh(vertices, faces)
    calls = {
        "contains": lambda n: mesh.contains(starts[:n]),
        "any_hits": lambda n: mesh.any_hits(starts[:n], ends[:n]),
        "first_hits.few": lambda n: mesh.first_hits(starts[:n], ends[:n], wanted=("face", "fraction")),
        "first_hits.all": lambda n: mesh.first_hits(starts[:n], ends[:n]),
    }
    print(f"{len(mesh)} faces, medians of {rounds} rounds in turn\n")
    print("| batch | queries | C++, ns | Python, ns | ratio |\n|---|---|---|---|---|")
    ratios = []
    with tempfile.NamedTemporaryFile() as file:
        file.write(np.array([len(vertices), len(faces), len(starts)], np.uint64).tobytes())
        for array in (vertices, faces, starts, ends):
            file.write(array.tobytes())
        file.flush()
        with subprocess.Popen([server, file.name], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as other:
            assert other.stdin is not None and other.stdout is not None and other.stdout.readline() == "ready\n"
            for kind, call in calls.items():
                for count in COUNTS:
                    ours, theirs = [], []
                    for _ in range(rounds):
                        other.stdin.write(f"{kind} {count}\n")
                        other.stdin.flush()
                        spent, hits = other.stdout.readline().split()
                        theirs.append(float(spent))
                        start = time.thread_time()
                        answer = call(count)
                        ours.append(time.thread_time() - start)
                        found = answer.hit if isinstance(answer, pierce.Hits) else answer
                        if int(found.sum()) != int(hits):
                            print(f"{kind}: {found.sum()} hits from Python, {hits} from C++", file=sys.stderr)
                            return 1
                        del answer, found
                    one, two = np.median(theirs), np.median(ours)
                    print(f"| {kind} | {count} | {one / count * 1e9:.0f} | {two / count * 1e9:.0f} | {two / one:.3f} |")
                    ratios.append(f"ratio python.{kind}.{count} {two / one:.3f}")
            other.stdin.close()
    print("", *ratios, sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
