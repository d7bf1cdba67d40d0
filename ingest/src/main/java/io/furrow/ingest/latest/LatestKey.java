package io.furrow.ingest.latest;

import java.nio.charset.StandardCharsets;
import java.util.Map;

import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;

/** What the records of {@code data.latest} are compacted by. */
public enum LatestKey {
    /** The entity's id. */
    ID,
    /** Tenant, service path and id. */
    IDENTITY;

    String of(ReportedEvent event) {
        return this == ID ? event.entityId() : event.identity();
    }

    /** The identity of the entity of a record with such a key. */
    String identityOf(TopicRecord latest) {
        String key = new String(latest.key(), StandardCharsets.UTF_8);
        if (this == IDENTITY) {
            return key;
        }
        Map<String, String> headers = latest.headers();
        return FiwareScope.of(headers.get(HeaderNames.SERVICE), headers.get(HeaderNames.SERVICE_PATH))
                .identity(key);
    }
}
