"""What does a Log look like in MCAP, for Foxglove and Lichtblick, and how does it come back?"""
