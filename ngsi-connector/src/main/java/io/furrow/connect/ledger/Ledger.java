package io.furrow.connect.ledger;

import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.concurrent.atomic.LongAdder;
import java.util.function.Supplier;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * Counts the records and requests of a source task since its start. Each input is counted in exactly one place; while no
 * request, repair or append is in progress,
 *
 * <pre>
 * received                   = accepted + dead + excluded
 * accepted + dead + repaired = durable + rejectedUnavailable
 * recovered + durable        = produced + skipped + lost + pending
 * </pre>
 *
 * <p>The unit is the received entity, which is also the unit of the resulting records: each entity or deletion of a
 * notification becomes one record, and each unreadable entity or body becomes one dead letter. Only counters described by
 * {@code requests} count HTTP requests. {@code pending} is a gauge of the journal.
 *
 * <p>The translation counts received, accepted, dead and excluded; the request handler counts rejectedUnavailable and all requests;
 * the journal counts recovered, durable (before it confirms them), lost and pending; the task counts produced and skipped,
 * when the worker reports them; the repair counts repaired, once its records are durable (records that are not durable are
 * retried and counted once), and repeated.
 */
public final class Ledger extends Metrics {
    private final Map<String, Supplier<JsonNode>> details = Collections.synchronizedMap(new LinkedHashMap<>());

    public final LongAdder requests = counter("requests", "POST requests of authorized senders whose body was read");
    public final LongAdder received =
            counter("received", "Entities received in notifications; an unreadable body counts as one");
    public final LongAdder accepted = counter("accepted", "Received entities that became a record of the topic");
    public final LongAdder dead = counter("dead", "Received entities and bodies that became a dead letter");
    public final LongAdder excluded = counter("excluded", "Received entities dropped because of their type");
    public final LongAdder rejectedUnavailable = counter(
            "rejectedUnavailable",
            "Accepted and dead records that did not become durable; no 2xx was sent for any of them");
    public final LongAdder durable = counter("durable", "Records on disk, dead letters and repaired ones included");
    public final LongAdder recovered = counter(
            "recovered",
            "Records in journals opened at the start or adopted later, not known to be in Kafka by then, readable or"
                    + " not");
    public final LongAdder produced = counter("produced", "Records that Kafka has acknowledged");
    public final LongAdder skipped =
            counter("skipped", "Records that a transformation filtered out or that the worker skips on errors");
    public final LongAdder lost = counter(
            "lost", "Records that were durable or recovered, and can no longer be read: corrupt in the journal");
    public final LongAdder corrupt =
            counter("corrupt", "Places in the journal that could not be read and were skipped");
    public final LongAdder repaired =
            counter("repaired", "Durable records of entities that the repair read from the context broker");
    public final LongAdder repeated = counter(
            "repeated",
            "Entities that the repair read and skipped, because the last record of each has the same state or a newer"
                    + " one");
    public final LongAdder gaps = counter("gaps", "Detected gaps in which notifications were or may have been missed");
    public final LongAdder oversized = counter(
            "oversized", "Durable records that became dead letters, because they exceed the record size of the topic");
    public final LongAdder clockAhead =
            counter("clockAhead", "Accepted entities whose own time is too far in the future");
    public final LongAdder clockUnset =
            counter("clockUnset", "Accepted entities whose own time is more than ten years ago");
    public final LongAdder unreadableTime =
            counter("unreadableTime", "Accepted entities whose own time has no form in which times are read");
    public final LongAdder undated = counter(
            "undated",
            "Accepted entities without dateModified, of which a change back to an earlier value cannot be distinguished"
                    + " from a duplicate");
    public final LongAdder unauthorized = counter("unauthorized", "Requests answered 401: a wrong or missing secret");
    public final LongAdder foreignTenant =
            counter("foreignTenant", "Requests answered 403: a tenant that is not allowed");
    public final LongAdder foreign = counter("foreign", "Requests answered 403: their Host or Origin is not allowed");
    public final LongAdder delayed = counter("delayed", "Requests whose records had to wait for space in the journal");
    public final LongAdder overload =
            counter("overload", "Requests reset or answered 503: no space, or not durable in time");
    public final LongAdder late =
            counter("late", "Requests counted in overload whose records may still become durable");
    public final LongAdder timedOut =
            counter("timedOut", "Requests whose sender was too slow or disconnected before its body was read");

    /**
     * Adds a value to {@code /health} that is not a number.
     *
     * @param now called when the page is shown: fast, thread-safe, and without exceptions
     */
    public void detail(String name, Supplier<JsonNode> now) {
        details.put(name, now);
    }

    /** All metrics and details as one object. */
    public ObjectNode toJson() {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        all().forEach(metric -> json.put(metric.name(), metric.now()));
        synchronized (details) {
            details.forEach((name, detail) -> json.set(name, detail.get()));
        }
        return json;
    }
}
