package io.furrow.mission.mongo;

import java.util.Optional;

import io.furrow.mission.RecordingExtent;

/**
 * A stored mission.
 *
 * @param name of the mission; the hash in the collection's name if no event contains the name
 * @param collection of its documents
 * @param span its first and last event time; empty if it has no event with a time yet
 */
public record StoredMission(String name, String collection, Optional<RecordingExtent> span) {}
