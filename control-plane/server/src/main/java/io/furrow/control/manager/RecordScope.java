package io.furrow.control.manager;

import java.nio.charset.StandardCharsets;

import org.apache.kafka.common.header.Header;
import org.apache.kafka.streams.processor.api.Record;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;

/** Tenant and service path of the entity that a record of {@code data.*} is of. */
public final class RecordScope {
    private RecordScope() {}

    public static FiwareScope of(Record<?, ?> record) {
        return FiwareScope.of(header(record, HeaderNames.SERVICE), header(record, HeaderNames.SERVICE_PATH));
    }

    /** The text of a header; null if there is none. */
    public static String header(Record<?, ?> record, String name) {
        Header header = record.headers().lastHeader(name);
        return header == null || header.value() == null ? null : new String(header.value(), StandardCharsets.UTF_8);
    }
}
