package io.furrow.replay.source;

import org.apache.flink.api.connector.source.SourceEvent;

/**
 * What is wanted of a replay, told to its reader.
 *
 * @param wanted value of the record of {@code service.replays}; null where it was removed: nobody wants the replay any more
 */
record WantedEvent(String replay, byte[] wanted) implements SourceEvent {}
