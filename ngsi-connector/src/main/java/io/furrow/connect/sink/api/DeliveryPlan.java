package io.furrow.connect.sink.api;

import java.util.List;

/**
 * The operations of one delivery: first the deletions, then the updates; no two updates are of one entity.
 *
 * @param partial deletions that are older than some attributes: they remove the other attributes
 * @param stale number of changes without a value newer than the known state
 * @param coalesced number of changes that were merged into another update or overridden by a deletion
 */
record DeliveryPlan(
        List<EntityChange> deletions,
        List<EntityChange> partial,
        List<AttributeUpdate> updates,
        int stale,
        int coalesced) {}
