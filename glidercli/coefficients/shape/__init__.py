"""What shape is a vehicle, and where do its surfaces lie?"""
