package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;

/**
 * The properties of a record that {@link LastRecordCache} tracks.
 *
 * @param identity tenant, service path, type and id of the entity
 * @param eventId {@code ce_id}
 * @param modified when the context broker stored the state of the record; empty if unknown
 * @param gone whether the record reports a deletion
 */
public record TrackedRecord(String identity, String eventId, Optional<Instant> modified, boolean gone) {}
