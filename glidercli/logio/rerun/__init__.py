"""What does a Log look like in a Rerun recording?"""
