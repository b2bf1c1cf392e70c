"""Runs the programs that are compared."""
import subprocess
import sys


def run(*command, environment=None):
    """Returns what a command prints; ends this program with its messages where it fails."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    if done.returncode != 0:
        sys.exit(f"{command[0]} ended with {done.returncode}:\n{done.stderr[-2000:]}{done.stdout[-2000:]}")
    return done.stdout + done.stderr
