/** Moves images out of events into a folder or a file system of Flink; the event keeps a reference. */
package io.furrow.ingest.image;
