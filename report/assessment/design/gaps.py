"""A gap whose required separation is compared with what is there."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod

from report.text.amounts import capacity, demand, shown_in_order
from report.text.units import Show, ratio


class ComparedGap(ABC):
    """A gap whose required separation is compared with what is there, given or in plan."""

    __slots__ = ()
    required_m: float  # required separation [m]; NaN without a permitted displacement
    mark: str  # of the required separation

    @property
    @abstractmethod
    def between(self) -> tuple[str, str]:
        """What is on either side."""

    @property
    @abstractmethod
    def provided_m(self) -> float:
        """What is there [m]."""

    @property
    def demand_capacity(self) -> float:
        """Required / provided separation; NaN without a required one."""
        if math.isnan(self.required_m):
            return math.nan
        return self.required_m / self.provided_m if self.provided_m > 0.0 else math.inf

    @property
    def ratio_words(self) -> str:
        """Required / provided separation for print, with its mark."""
        return ratio(self.demand_capacity) + self.mark

    @property
    def shows(self) -> tuple[Show, Show]:
        """How what is there and what is required are shown beside each other."""
        return shown_in_order(capacity(self.provided_m), demand(self.required_m))

    def involves(self, array_id: str) -> bool:
        """Whether an array is on either side of the gap."""
        return array_id in self.between

    def across_from(self, array_id: str) -> str:
        """Return what is on the other side of the gap."""
        first, other = self.between
        return first if other == array_id else other
