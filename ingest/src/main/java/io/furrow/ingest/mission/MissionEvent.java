package io.furrow.ingest.mission;

import io.furrow.flink.record.TopicRecord;

/**
 * An event and the mission that it belongs to.
 *
 * @param domain empty if there is none
 * @param mission empty if there is none
 * @param record as it goes to the mission's topic, event id and hop stamps in its headers; no value where the entity was deleted
 */
public record MissionEvent(String domain, String mission, TopicRecord record) {}
