package io.furrow.replay.source;

import org.apache.flink.api.connector.source.SourceEvent;

/**
 * A change of a replay's desired state, sent to its reader.
 *
 * @param wanted value of the record of {@code service.replays}; null if it was removed: nobody wants the replay any more
 */
record WantedEvent(String replay, byte[] wanted) implements SourceEvent {}
