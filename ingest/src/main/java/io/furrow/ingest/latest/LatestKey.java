package io.furrow.ingest.latest;

import java.nio.charset.StandardCharsets;
import java.util.Map;

import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;

/** The key by which the records of {@code data.latest} are compacted. */
public enum LatestKey {
    /** The entity's id. */
    ID,
    /** Tenant, service path and id. */
    IDENTITY;

    /** @param otherType of an entity that is not the first of its id; empty for the first */
    String of(ReportedEvent event, String otherType) {
        return (this == ID ? event.entityId() : event.identity()) + suffix(otherType);
    }

    /** No id contains a space. */
    private static String suffix(String otherType) {
        return otherType.isEmpty() ? "" : " " + otherType;
    }

    /** The type of an entity that is not the first of its id; empty for the first. */
    static String otherTypeOf(TopicRecord latest) {
        String type = latest.headers().getOrDefault(HeaderNames.ENTITY_TYPE, "");
        return new String(latest.key(), StandardCharsets.UTF_8).endsWith(suffix(type)) ? type : "";
    }

    /** The identity, without type, of the entity of a record with such a key. */
    String identityOf(TopicRecord latest) {
        String whole = new String(latest.key(), StandardCharsets.UTF_8);
        String key =
                whole.substring(0, whole.length() - suffix(otherTypeOf(latest)).length());
        if (this == IDENTITY) {
            return key;
        }
        Map<String, String> headers = latest.headers();
        return FiwareScope.of(headers).identity(key);
    }
}
