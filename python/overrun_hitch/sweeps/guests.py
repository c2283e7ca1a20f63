"""The guests of one thread, one for each FMU; where one is lost in mid-batch, the run to blame is found."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from overrun_hitch.fmu.guest import Guest, GuestLate, GuestLost
from overrun_hitch.sweeps.job import Batch, Done, Job
from overrun_hitch.sweeps.runner import Runner, runner


class Guests:
    """A job, for one thread. Whoever makes one must close it; any thread may."""

    def __init__(self, job: Job, time_limit: float) -> None:
        self._job = job
        self._time_limit = time_limit  # s, of a run
        self._guests: dict[int, Guest] = {}

    def close(self) -> None:
        """End them."""
        for guest in list(self._guests.values()):
            guest.close()

    def run(self, batch: Batch) -> Done:
        """Run all of them; `messages` tells which failed and why. The rest goes on where a guest is lost."""
        waiting = [(part, "") for part in _by_fmu(batch)]
        done = []
        while waiting:
            part, failure = waiting.pop(0)
            guest = self._of(int(part.fmu[0]))
            try:
                done.append(Done.failed(self._job, failure) if failure else guest.call(Runner.run, part))
            except GuestLost as error:
                at = min(max(guest.place, 0), len(part) - 1)
                # What crashed may have been spoilt by a run before, so it gets another chance, alone.
                is_sure = len(part) == 1 or isinstance(error, GuestLate)
                before, after = part.part(slice(at)), part.part(slice(at + 1, None))
                pieces = [(before, ""), (part.part(slice(at, at + 1)), str(error) if is_sure else ""), (after, "")]
                waiting[:0] = [piece for piece in pieces if len(piece[0])]
        return Done.joined(done)

    def _of(self, place: int) -> Guest:
        if place not in self._guests:
            fmu = self._job.fmus[place]
            self._guests[place] = Guest(fmu.name, self._time_limit, runner, replace(self._job, fmus=()), fmu)
        return self._guests[place]


def _by_fmu(batch: Batch) -> list[Batch]:
    """Parts of one FMU each, in order."""
    ends = [*(np.flatnonzero(np.diff(batch.fmu)) + 1).tolist(), len(batch)]
    return [batch.part(slice(first, end)) for first, end in zip([0, *ends], ends, strict=False)]
