package io.furrow.connect.source.notification;

import java.time.Instant;
import java.util.function.UnaryOperator;

import io.furrow.model.event.FiwareScope;

/**
 * An HTTP request as it was received.
 *
 * @param body the whole body, or its beginning if {@code complete} is false
 * @param complete whether the body was within the limit
 * @param attrsFormat header {@code Ngsiv2-AttrsFormat}, or null
 * @param scope the tenant and service path of the headers
 * @param sender remote address and path, for messages: {@code 10.0.0.7 /notify}
 */
public record ReceivedNotification(
        byte[] body, boolean complete, String attrsFormat, FiwareScope scope, Instant at, String sender) {
    /** Creates a notification; the headers are looked up by name, case-insensitively, null for a missing header. */
    public static ReceivedNotification of(
            byte[] body, boolean complete, UnaryOperator<String> header, Instant at, String sender) {
        return new ReceivedNotification(body, complete, header.apply("Ngsiv2-AttrsFormat"), scope(header), at, sender);
    }

    /** NGSI-v2 names its tenant in {@code Fiware-Service}, NGSI-LD in {@code NGSILD-Tenant}. */
    public static FiwareScope scope(UnaryOperator<String> header) {
        String service = header.apply("Fiware-Service");
        return FiwareScope.of(
                service == null ? header.apply("NGSILD-Tenant") : service, header.apply("Fiware-Servicepath"));
    }
}
