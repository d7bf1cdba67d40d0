/** Kills the task manager of the job {@code ingest} under load, and compares the result with an undisturbed run. */
package io.furrow.soak.ingest;
