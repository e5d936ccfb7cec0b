"""What would the sensors aboard have recorded of a simulated flight? Settings, errors, and one file a sensor."""
