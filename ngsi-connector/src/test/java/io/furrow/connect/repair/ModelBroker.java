package io.furrow.connect.repair;

import java.net.URLDecoder;
import java.net.http.HttpHeaders;
import java.time.Instant;
import java.time.ZoneOffset;
import java.time.format.DateTimeFormatter;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.TimeUnit;
import java.util.function.Function;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.broker.ResponseHeaders;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.unchecked.Unchecked;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * A context broker in memory with one subscription, as far as a repair sees it: it counts what it begins to send, keeps what it
 * has not sent in a queue, and may lose all of that. What becomes of the queue is up to the test.
 */
final class ModelBroker implements Function<BrokerRequest, Outcome> {
    /** An entity, which is never changed: a change makes another one. */
    record Stored(String id, String type, String value, long created, long modified) {
        String key() {
            return id + " " + type;
        }

        ObjectNode json(boolean isDeletion) {
            ObjectNode json =
                    JsonNodeFactory.instance.objectNode().put("id", id).put("type", type);
            attribute(json, "t", "Text", value);
            if (type.equals("Timed")) {
                attribute(json, "TimeInstant", "DateTime", "2026-01-01T00:00:00.000Z");
            }
            attribute(json, "dateModified", "DateTime", time(modified));
            attribute(json, "dateCreated", "DateTime", time(created));
            if (isDeletion) {
                attribute(json, "alterationType", "Text", "entityDelete");
            }
            return json;
        }

        private static void attribute(ObjectNode json, String name, String type, String value) {
            json.putObject(name).put("type", type).put("value", value).putObject("metadata");
        }
    }

    /** What the subscription reports one change. */
    record Told(String subscription, Stored entity, boolean gone) {}

    private static final long HOUR = 3_600_000;

    final Map<String, Stored> entities = new TreeMap<>();
    final List<Told> queue = new ArrayList<>();
    private final boolean tellsDeletions;
    private final Runnable meanwhile;
    private ObjectNode subscription;
    private int made;
    private long sent;
    private long flushed;
    private Long lastSuccess;
    private Long lastFailure;
    private long clock = Instant.parse("2026-01-02T00:00:00Z").toEpochMilli();
    private long started = clock - HOUR;
    private boolean isAway;
    /** What is on its volume while that is not mounted. */
    private Volume volume;

    private record Volume(Map<String, Stored> entities, ObjectNode subscription, long flushed) {}

    /** @param meanwhile what happens while it answers */
    ModelBroker(boolean tellsDeletions, Runnable meanwhile) {
        this.tellsDeletions = tellsDeletions;
        this.meanwhile = meanwhile;
    }

    void pass(long millis) {
        clock += millis;
    }

    void put(String id, String type, String value) {
        Stored before = entities.get(id + " " + type);
        if (before == null) {
            clock++; // what is deleted and made again within a millisecond cannot be reported from what is not
        }
        Stored after = new Stored(id, type, value, before == null ? clock : before.created(), clock);
        entities.put(after.key(), after);
        tell(after, false);
    }

    void delete(String key) {
        Stored gone = entities.remove(key);
        if (gone != null && tellsDeletions) {
            tell(gone, true);
        }
    }

    private void tell(Stored entity, boolean gone) {
        if (subscription != null && subscription.path("status").asText().equals("active")) {
            sent++;
            queue.add(new Told(subscription.path("id").asText(), entity, gone));
        }
    }

    void succeeded() {
        lastSuccess = clock;
    }

    void failed() {
        lastFailure = clock;
    }

    void flush() {
        flushed = sent;
    }

    /** What waits is lost, and what was counted since it was last flushed. */
    void restart() {
        queue.clear();
        sent = flushed;
        started = clock;
    }

    /** It starts without the volume of its database, and answers as if it were new. */
    void unmount() {
        volume = new Volume(new TreeMap<>(entities), subscription, flushed);
        entities.clear();
        subscription = null;
        restart();
    }

    boolean isMounted() {
        return volume == null;
    }

    boolean isSubscribed() {
        return subscription != null;
    }

    /** It starts again with the volume. */
    void mount() {
        entities.clear();
        entities.putAll(volume.entities());
        subscription = volume.subscription();
        flushed = volume.flushed();
        volume = null;
        restart();
    }

    /** Its clock, which is also that of the source. */
    long nanos() {
        return TimeUnit.MILLISECONDS.toNanos(clock);
    }

    void forgetSubscription() {
        subscription = null;
    }

    void stopSubscription() {
        if (subscription != null) {
            subscription.put("status", "inactive");
        }
    }

    void away(boolean now) {
        isAway = now;
    }

    @Override
    public Outcome apply(BrokerRequest request) {
        meanwhile.run();
        Outcome outcome =
                isAway ? new Outcome.Unavailable("it is away", java.util.Optional.empty(), null, 0) : answer(request);
        meanwhile.run();
        return outcome;
    }

    private Outcome answer(BrokerRequest request) {
        String path = request.path();
        if (path.equals("/version")) {
            long seconds = (clock - started) / 1000;
            return done("{\"orion\": {\"uptime\": \"%d d, %d h, %d m, %d s\"}}"
                    .formatted(seconds / 86_400, seconds / 3600 % 24, seconds / 60 % 60, seconds % 60));
        }
        if (path.startsWith("/v2/subscriptions")) {
            return subscriptions(request);
        }
        Map<String, String> query = new HashMap<>();
        for (String parameter : path.substring(path.indexOf('?') + 1).split("&")) {
            int equals = parameter.indexOf('=');
            query.put(parameter.substring(0, equals), URLDecoder.decode(parameter.substring(equals + 1), UTF_8));
        }
        return done(NgsiJson.write(page(query)));
    }

    private ArrayNode page(Map<String, String> query) {
        boolean byCreation = query.getOrDefault("orderBy", "").startsWith("dateCreated");
        Comparator<Stored> order = Comparator.<Stored>comparingLong(
                        entity -> byCreation ? entity.created() : entity.modified())
                .thenComparing(Stored::key);
        String q = query.getOrDefault("q", "x>=1970-01-01T00:00:00Z");
        long from = Instant.parse(q.substring(q.indexOf('=') + 1)).toEpochMilli();
        List<String> attrs = List.of(query.get("attrs").split(","));
        ArrayNode page = JsonNodeFactory.instance.arrayNode();
        entities.values().stream()
                .filter(entity -> !query.containsKey("id") || entity.id().equals(query.get("id")))
                .filter(entity -> !query.containsKey("type") || entity.type().equals(query.get("type")))
                .filter(entity -> (byCreation ? entity.created() : entity.modified()) >= from)
                .sorted(order)
                .skip(Integer.parseInt(query.getOrDefault("offset", "0")))
                .limit(Integer.parseInt(query.get("limit")))
                .map(entity -> shown(entity.json(false), attrs))
                .forEach(page::add);
        return page;
    }

    private static ObjectNode shown(ObjectNode json, List<String> attrs) {
        if (!attrs.contains("*")) {
            json.remove(List.of("t", "TimeInstant"));
        }
        return json;
    }

    private Outcome subscriptions(BrokerRequest request) {
        if (request.method().equals("POST")) {
            subscription = (ObjectNode) read(request.body());
            subscription.put("id", "%024x".formatted(++made)).put("status", "active");
            sent = 0;
            flushed = 0;
            lastSuccess = null;
            lastFailure = null;
            return new Outcome.Done(
                    201,
                    headers(Map.of(
                            "Location",
                            "/v2/subscriptions/" + subscription.path("id").asText())),
                    new byte[0]);
        }
        if (request.method().equals("PATCH")) {
            if (subscription == null) {
                return new Outcome.Absent("404");
            }
            subscription.setAll((ObjectNode) read(request.body()));
            return new Outcome.Done(204, headers(Map.of()), new byte[0]);
        }
        ArrayNode all = JsonNodeFactory.instance.arrayNode();
        if (subscription != null) {
            ObjectNode shown = all.addObject().setAll(subscription.deepCopy());
            ObjectNode notification = (ObjectNode) shown.get("notification");
            if (sent > 0) {
                notification.put("timesSent", sent);
            }
            if (lastSuccess != null) {
                notification.put("lastSuccess", time(lastSuccess / 1000 * 1000));
            }
            if (lastFailure != null) {
                notification.put("lastFailure", time(lastFailure / 1000 * 1000));
            }
        }
        return done(NgsiJson.write(all));
    }

    private static JsonNode read(byte[] json) {
        return Unchecked.get(() -> NgsiJson.read(json));
    }

    private Outcome done(String json) {
        return done(json.getBytes(UTF_8));
    }

    private Outcome done(byte[] json) {
        String date = DateTimeFormatter.RFC_1123_DATE_TIME.format(
                Instant.ofEpochMilli(clock).atOffset(ZoneOffset.UTC));
        return new Outcome.Done(200, headers(Map.of("Date", date)), json);
    }

    private static ResponseHeaders headers(Map<String, String> named) {
        Map<String, List<String>> all = new HashMap<>();
        named.forEach((name, value) -> all.put(name, List.of(value)));
        return new ResponseHeaders(HttpHeaders.of(all, (name, value) -> true));
    }

    private static String time(long millis) {
        return DateTimeFormatter.ofPattern("yyyy-MM-dd'T'HH:mm:ss.SSSX")
                .format(Instant.ofEpochMilli(millis).atOffset(ZoneOffset.UTC));
    }
}
