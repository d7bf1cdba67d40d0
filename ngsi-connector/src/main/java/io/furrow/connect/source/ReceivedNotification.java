package io.furrow.connect.source;

import java.time.Instant;

import io.furrow.model.event.FiwareScope;

/**
 * One HTTP request as it came in.
 *
 * @param body the whole body, or its beginning if {@code complete} is false
 * @param complete whether the body was within the limit
 * @param attrsFormat header {@code Ngsiv2-AttrsFormat}, or null
 * @param scope headers {@code Fiware-Service} and {@code Fiware-Servicepath}
 * @param sender who sent it and where to, for people: {@code 10.0.0.7 /notify}
 */
record ReceivedNotification(
        byte[] body, boolean complete, String attrsFormat, FiwareScope scope, Instant at, String sender) {}
