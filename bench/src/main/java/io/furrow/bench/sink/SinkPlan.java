package io.furrow.bench.sink;

/**
 * What the sink has to write.
 *
 * @param records in the topic before the sink starts
 * @param entities that they are about; as many as records if each is about its own
 * @param payloadBytes of a notification with such an entity
 */
public record SinkPlan(int records, int entities, int payloadBytes) {}
