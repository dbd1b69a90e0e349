# Generated from include/kinesphere.h by interface/generate.py: change the header, and run that.
"""What events are about. Members are whole numbers, as in tables of events; their texts are their names."""

from .named import Named


class EventKind(Named):
    """Kinds of events, in the order of their delivery within one instant."""

    bound_violation = 0
    """A reported state contradicts the motion limits of its body."""
    contact_begin = 1
    """Two bodies touch: their gap has come down to at most the contact tolerance."""
    contact_end = 2
    """Two bodies that touched are apart: their gap has grown to the separation distance."""
    wall_begin = 3
    """A body touches a wall of the box."""
    wall_end = 4
    """A body that touched a wall is clear of it."""
    zeno_guard = 5
    """Time would have stopped at a contact deep within its tolerance; it goes on by its least step. The two
    may come to overlap by more than the tolerance. If it comes often, a response does not part its bodies, or
    a body reaches through a wall.
    """
    sensor_enter = 6
    """The gap of two bodies has come down to a sensor distance."""
    sensor_leave = 7
    """The gap of two bodies that were within a sensor distance has grown beyond it."""
    woke = 8
    """A body that slept is awake again."""
    timer = 9
    """A timer of the caller's own, after all other events of its time. It names None, and its first_user_data
    is that of the timer.
    """


class Wall(Named):
    """The walls of the box of a world."""

    none = 0
    x_lower = 1
    x_upper = 2
    y_lower = 3
    y_upper = 4
    z_lower = 5
    z_upper = 6


class Senses(Named):
    """Which bodies of an event sense the other one."""

    neither = 0
    first = 1
    second = 2
    both = 3


class Verdict(Named):
    """What the reports prove about two tracks and a separation."""

    apart = 0
    """The two certainly are not within the separation."""
    undecided = 1
    """The reports prove neither of the other two."""
    within = 2
    """They certainly are within it, or outside of it by at most the tolerance."""


class MonitorEventKind(Named):
    """Kinds of events of a monitor."""

    verdict = 0
    """The verdict about two tracks and a separation changes."""
    predicted = 1
    """If both go straight on, two tracks come within a separation, in its look-ahead time: no guarantee."""
    prediction_ended = 2
    """They have passed each other, or a report shows that they will not come near."""
    contradiction = 3
    """A report contradicts the earlier ones of its track."""
    resolved = 4
    """A contradiction has ended: later reports show which one was wrong."""
    stale = 5
    """The latest report of a track has reached the age stale_after."""
    resumed = 6
    """A stale track has reported again."""
    dropped = 7
    """A track was removed, or its latest report has reached the age drop_after."""
    reclassified = 8
    """A report has given the track another class; it starts anew. Comes before all others of its time."""
