package io.furrow.connect.ledger;

import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.function.LongSupplier;
import java.util.function.Supplier;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * What one task has counted since its start. Whatever comes in is in exactly one place; at any quiet moment, which is one in
 * which no request, repair or append is under way,
 *
 * <pre>
 * received                   = accepted + dead + excluded
 * accepted + dead + repaired = durable + turnedAway
 * recovered + durable        = produced + skipped + lost + pending
 * </pre>
 *
 * <p>The unit is the entity that came in, which is the record that is made of it: one entity (or deletion) of a notification
 * makes one record, and so does each entity or body that cannot be read, whose record is a dead letter. Only what has
 * {@code requests} in its sentence counts HTTP requests. {@code pending} is a gauge of the journal.
 *
 * <p>Who counts what: the translation counts received, accepted, dead and excluded; the handler of requests turnedAway and all
 * that counts requests; the journal recovered, durable (before it says so to anybody), lost and pending; the task produced and
 * skipped, when the worker tells it; the repair repaired, once what it emitted is durable (what is not, it tries again and
 * counts once), and repeated.
 */
public final class Ledger implements Numbers {
    private final List<Counter> counters = new ArrayList<>();
    private final List<Gauge> gauges = new CopyOnWriteArrayList<>();
    private final Map<String, Supplier<JsonNode>> details = Collections.synchronizedMap(new LinkedHashMap<>());

    public final Counter requests = counter("requests", "POST requests whose sender may send and whose body was read");
    public final Counter received =
            counter("received", "Entities that notifications brought, a body that cannot be read counting as one");
    public final Counter accepted = counter("accepted", "Received entities that became a record of the topic");
    public final Counter dead = counter("dead", "Received entities and bodies that became a dead letter");
    public final Counter excluded = counter("excluded", "Received entities dropped because of their type");
    public final Counter turnedAway = counter(
            "turnedAway", "Accepted and dead records that did not become durable; no 2xx was sent for any of them");
    public final Counter durable = counter("durable", "Records on disk, dead letters and repaired ones included");
    public final Counter recovered = counter(
            "recovered",
            "Records in journals opened at the start or adopted later, not known to be in Kafka by then, readable or not");
    public final Counter produced = counter("produced", "Records that Kafka has acknowledged");
    public final Counter skipped =
            counter("skipped", "Records that a transformation filtered out or the worker was told to skip on errors");
    public final Counter lost = counter(
            "lost", "Records that were durable or recovered, and can no longer be read: corrupt in the journal");
    public final Counter corrupt = counter("corrupt", "Places in the journal that could not be read and were skipped");
    public final Counter repaired =
            counter("repaired", "Durable records of entities that the repair read from the context broker");
    public final Counter repeated = counter(
            "repeated",
            "Entities that the repair read and passed over, because the last record of each tells the same state or a newer one");
    public final Counter gaps = counter("gaps", "Times that notifications were or may have been missed");
    public final Counter oversized = counter(
            "oversized", "Durable records that became dead letters, because the topic takes no record so large");
    public final Counter clockAhead =
            counter("clockAhead", "Accepted entities whose own time is too far in the future");
    public final Counter undated = counter(
            "undated",
            "Accepted entities without dateModified, of which a change back to an earlier value cannot be told from a duplicate");
    public final Counter unauthorized = counter("unauthorized", "Requests answered 401: a wrong secret, or none");
    public final Counter foreignTenant =
            counter("foreignTenant", "Requests answered 403: a tenant that is not allowed");
    public final Counter foreign =
            counter("foreign", "Requests answered 403: they name a host, or come from a page, that is not allowed");
    public final Counter held = counter("held", "Requests whose records had to wait for room in the journal");
    public final Counter overload =
            counter("overload", "Requests reset or answered 503: there was no room, or no durability in time");
    public final Counter late = counter(
            "late", "Requests of overload whose records may still become durable: they were taken, only not in time");
    public final Counter cut =
            counter("cut", "Requests whose sender was too slow or went away before its body was read");

    /** All zero, without gauges. */
    public Ledger() {}

    private Counter counter(String name, String help) {
        Counter counter = new Counter(name, help);
        counters.add(counter);
        return counter;
    }

    /** Shows one number of now more, for instance what is pending. */
    public void gauge(String name, String help, LongSupplier now) {
        gauges.add(new Gauge(name, help, now));
    }

    /**
     * Shows something on {@code /health} that is no number.
     *
     * @param now called by whoever looks: quick, from any thread, and without throwing
     */
    public void detail(String name, Supplier<JsonNode> now) {
        details.put(name, now);
    }

    /** What is shown on {@code /health} besides the numbers, in the order in which it was added. */
    public Map<String, Supplier<JsonNode>> details() {
        synchronized (details) {
            return new LinkedHashMap<>(details);
        }
    }

    /** In a fixed order. */
    @Override
    public List<Counter> counters() {
        return List.copyOf(counters);
    }

    /** In the order in which they were added. */
    @Override
    public List<Gauge> gauges() {
        return List.copyOf(gauges);
    }
}
