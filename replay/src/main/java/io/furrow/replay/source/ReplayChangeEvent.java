package io.furrow.replay.source;

import org.apache.flink.api.connector.source.SourceEvent;

/**
 * A change of a replay's desired state, sent to its reader.
 *
 * @param desired value of the record of {@code service.replays}; null if it was removed
 */
record ReplayChangeEvent(String replay, byte[] desired) implements SourceEvent {}
