/** The job {@code ingest} whose task manager is killed under load, beside the same job undisturbed. */
package io.furrow.soak.ingest;
