"""Where a command's time goes."""

import time


class Stopwatch:
    """Seconds by part, and in all."""

    def __init__(self) -> None:
        self.started = self.last = time.perf_counter()
        self.laps: dict[str, float] = {}

    def lap(self, name: str) -> None:
        """End the part that began with the last lap; parts of one name add up."""
        now = time.perf_counter()
        self.laps[name], self.last = self.laps.get(name, 0.0) + now - self.last, now

    def seconds(self) -> dict[str, float]:
        """Every part and the total, to the millisecond."""
        parts = self.laps | {"total": self.last - self.started}
        return {name: round(value, 3) for name, value in parts.items()}
