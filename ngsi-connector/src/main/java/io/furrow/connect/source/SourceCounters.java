package io.furrow.connect.source;

import java.util.concurrent.atomic.LongAdder;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** What the source has counted since it started. */
final class SourceCounters {
    /** Requests with a body that was read. */
    final LongAdder notifications = new LongAdder();
    /** Entities passed on. */
    final LongAdder accepted = new LongAdder();
    /** Entities dropped because of their type. */
    final LongAdder excluded = new LongAdder();
    /** Dead letters. */
    final LongAdder rejected = new LongAdder();
    /** Entities whose device's clock is too far ahead. */
    final LongAdder clockAhead = new LongAdder();
    /** Requests answered 503 because there was no room, or the source was stopping. */
    final LongAdder unavailable = new LongAdder();
    /** Requests answered 504 because Kafka took too long; their records may still arrive. */
    final LongAdder unconfirmed = new LongAdder();
    /** Records that a transformation filtered out or that the worker was told to skip on errors. */
    final LongAdder skipped = new LongAdder();

    ObjectNode toJson() {
        return JsonNodeFactory.instance
                .objectNode()
                .put("notifications", notifications.sum())
                .put("accepted", accepted.sum())
                .put("excluded", excluded.sum())
                .put("rejected", rejected.sum())
                .put("clockAhead", clockAhead.sum())
                .put("unavailable", unavailable.sum())
                .put("unconfirmed", unconfirmed.sum())
                .put("skipped", skipped.sum());
    }
}
