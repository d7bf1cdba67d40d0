/**
 * Stored missions: the documents and lines of their events, and how both are read page by page.
 *
 * <p><b>In</b>: events of missions, from MongoDB, files or topics.
 *
 * <p><b>Out</b>: pages of events in their order, the latest state at a moment, densities, markers.
 *
 * <p><b>Must not know</b>: Flink, Kafka Streams, and who plays or shows a recording.
 */
package io.furrow.mission;
