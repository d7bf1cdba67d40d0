package io.furrow.mission.mongo;

import java.util.Optional;

import io.furrow.mission.RecordingExtent;

/**
 * A mission that is stored.
 *
 * @param name of the mission; what stands for it in {@code collection} where only a hash of a long name is there and no event names it
 * @param collection of its documents
 * @param span its first and last event time; empty if it has no event with a time yet
 */
public record StoredMission(String name, String collection, Optional<RecordingExtent> span) {}
