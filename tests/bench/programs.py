# SPDX-License-Identifier: BSD-3-Clause
"""Runs the benchmark programs, alone or on ranks."""
import os
import subprocess


class Failed(Exception):
    """A run that gave no result; the text says why."""


# Makes waiting threads sleep, because other processes may use the cores.
SHARED_CORES = {"OMP_WAIT_POLICY": "passive"}


def text_of(command, threads, time_limit, variables=SHARED_CORES):
    """Returns the output of a command with these environment variables. Its standard input is
    empty."""
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads), **variables)
    try:
        done = subprocess.run([str(word) for word in command], env=environment,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=time_limit)
    except subprocess.TimeoutExpired:
        raise Failed(f"not done after {time_limit:.0f} s") from None
    if done.returncode != 0:
        raise Failed(f"status {done.returncode}: {first_words(done.stderr)}")
    return done.stdout


def first_words(text):
    """Returns the first paragraph of an error in one line, without the rules that Open MPI draws
    around it."""
    said = []
    for line in text.splitlines():
        line = line.strip()
        if line.strip("-=*"):
            said.append(line)
        elif said:
            break
    return " ".join(said) or "no message"


def on_ranks(mpiexec, ranks, program, *arguments):
    """Returns the command that runs a program on this number of ranks, which may exceed the number
    of cores."""
    return [mpiexec, "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1",
            "-np", ranks, program, *arguments]


def line_of_ranks(mpiexec, ranks, threads, time_limit, program, *arguments):
    """Returns the pairs of words that a program prints on this number of ranks."""
    text = text_of(on_ranks(mpiexec, ranks, program, *arguments), threads, time_limit)
    words = text.split()
    if len(words) < 2:
        raise Failed("it printed nothing")
    return dict(zip(words[0::2], words[1::2]))
