package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;

/**
 * What {@link LastRecords} needs to know of a record.
 *
 * @param identity tenant, service path and id of the entity
 * @param type of the entity; empty for any
 * @param eventId {@code ce_id}
 * @param modified when the context broker stored the state that it tells; empty where that is not known
 * @param gone whether it tells that the entity was deleted
 */
public record EntityRecord(
        String identity, Optional<String> type, String eventId, Optional<Instant> modified, boolean gone) {}
