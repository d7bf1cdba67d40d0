package io.furrow.ingest.latest;

import io.furrow.ingest.route.ReportedEvent;

/** What the records of {@code data.latest} are compacted by. */
public enum LatestKey {
    /** The entity's id. */
    ID,
    /** Tenant, service path and id. */
    IDENTITY;

    String of(ReportedEvent event) {
        return this == ID ? event.entityId() : event.identity();
    }
}
