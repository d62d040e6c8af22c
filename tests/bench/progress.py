# SPDX-License-Identifier: BSD-3-Clause
"""Shows the progress of a long benchmark."""
import sys
import time


class Progress:
    """A progress bar on a terminal, by tqdm if it is installed. Otherwise it prints a line for each
    job."""

    WIDTH = 30

    def __init__(self, total):
        self.total, self.done, self.bar, self.started = total, 0, None, time.monotonic()
        if sys.stderr.isatty():
            try:
                from tqdm import tqdm
                self.bar = tqdm(total=total, unit="run", dynamic_ncols=True)
            except ImportError:
                pass

    def begin(self, what):
        if self.bar is not None:
            self.bar.set_postfix_str(what)
        elif sys.stderr.isatty():
            filled = self.WIDTH * self.done // self.total
            sys.stderr.write(f"\r\033[K[{'#' * filled}{' ' * (self.WIDTH - filled)}] "
                             f"{self.done}/{self.total}{self.time_left()}, {what}")
            sys.stderr.flush()
        else:
            sys.stderr.write(f"{self.done + 1}/{self.total} {what}\n")

    def time_left(self):
        if self.done == 0:
            return ""
        left = (time.monotonic() - self.started) / self.done * (self.total - self.done)
        return f", about {left / 60:.0f} min left"

    def end(self, jobs=1):
        """Counts this number of jobs as done or skipped."""
        self.done += jobs
        if self.bar is not None:
            self.bar.update(jobs)
            if self.done == self.total:
                self.bar.close()
        elif sys.stderr.isatty() and self.done == self.total:
            sys.stderr.write("\r\033[K")
