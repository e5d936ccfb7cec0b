"""How is a log watched while it plays or grows? A source of pieces, and viewers that they go to."""

from glidercli.live.choices import Choices, check_choices
from glidercli.live.following import following
from glidercli.live.showing import show
from glidercli.live.watching import follow

__all__ = ["Choices", "check_choices", "follow", "following", "show"]
