package io.furrow.ingest.mission;

import io.furrow.flink.record.TopicRecord;

/**
 * An event with its mission.
 *
 * @param domain empty if there is none
 * @param mission empty if there is none
 * @param record for the mission's topic, with event id and hop stamps as headers; without a value for a deleted entity
 */
public record MissionEvent(String domain, String mission, TopicRecord record) {}
