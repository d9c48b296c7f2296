"""New shots for a study's table: read, looked at beside the table and the model, appended."""
