package io.furrow.cli.compare;

import java.util.Map;

import io.furrow.model.event.HeaderNames;

/**
 * A record of results, or of a replay.
 *
 * @param place for instance {@code data.collision-0@17}
 * @param value null for none
 */
record ResultRecord(String place, Map<String, String> headers, byte[] value) {
    /** The epoch of the replay; 0 for none. */
    long epoch() {
        String epoch = headers.getOrDefault(HeaderNames.REPLAY_EPOCH, "");
        return epoch.matches("[0-9]{1,18}") ? Long.parseLong(epoch) : 0;
    }

    /** Tenant and service path. */
    String scope() {
        return headers.getOrDefault(HeaderNames.SERVICE, "") + "|" + headers.getOrDefault(HeaderNames.SERVICE_PATH, "");
    }
}
