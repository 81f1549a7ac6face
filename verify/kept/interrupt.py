# SPDX-License-Identifier: BSD-3-Clause
"""interrupt.py STEP COMMAND ...: runs `delam run` and interrupts it, as Ctrl-C does, when it shows this step. Exit code
0 only if the run ended there, unfinished."""
import signal
import subprocess
import sys

INTERRUPTED = 130


def main():
    step, command = int(sys.argv[1]), sys.argv[2:]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        sent = False
        for line in process.stdout:
            if not sent and line.startswith(f"step {step}/"):
                process.send_signal(signal.SIGINT)
                sent = True
    return 0 if process.returncode == INTERRUPTED else 1


if __name__ == "__main__":
    sys.exit(main())
