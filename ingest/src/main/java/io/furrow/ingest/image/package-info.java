/** Moves images out of events into files; the event keeps a reference. */
package io.furrow.ingest.image;
