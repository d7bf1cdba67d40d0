package io.furrow.connect.repair;

import java.io.IOException;
import java.io.OutputStream;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import com.sun.net.httpserver.HttpExchange;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.BrokerSettings;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.repair.RepairSettings.Deletions;
import io.furrow.connect.repair.RepairSettings.Mode;
import io.furrow.connect.repair.RepairSettings.Reading;
import io.furrow.connect.subscription.DesiredSubscription;
import io.furrow.connect.subscription.IdPartition;
import io.furrow.connect.subscription.NotificationContent;
import io.furrow.connect.subscription.Subject;
import io.furrow.connect.subscription.Target;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;
import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;

/** A process of its own that repairs from a context broker with large entities, and is sent many ids, on a small heap. */
final class PressedRepair {
    static final int IMAGES = 60;

    private static final int MIB = 1024 * 1024;
    private static final long BOUND = 8L * MIB;
    private static final FiwareScope EVERYWHERE = new FiwareScope("agri", "/#");
    private static final Instant T = Instant.parse("2026-11-21T12:00:00Z");
    private static final Pattern NUMBER = Pattern.compile("[?&](limit|offset)=(\\d+)");
    private static final Pattern FROM = Pattern.compile("q=dateModified%3E%3D([^&]*)");
    private static final Pattern ID = Pattern.compile("[?&]id=e(\\d+)");

    private PressedRepair() {}

    /** @param args a folder */
    public static void main(String[] args) throws Exception {
        StubServer server = new StubServer(PressedRepair::answer);
        BrokerClient client = new BrokerClient(
                BrokerSettings.of(server.uri(""), Duration.ofSeconds(60)).withMaxAnswerBytes(16L * MIB));
        RecordTracker live = new RecordTracker(BOUND);
        int[] counts = new int[2];
        RepairOutput output = new RepairOutput() {
            @Override
            public byte[] serialize(String subscription, MissedChange finding) {
                return finding instanceof MissedChange.Changed changed
                        ? changed.event().entity().toBytes()
                        : new byte[1];
            }

            @Override
            public Optional<CompletableFuture<Void>> append(List<byte[]> records) {
                records.forEach(record -> counts[record.length > 1 ? 0 : 1]++);
                return Optional.of(CompletableFuture.completedFuture(null));
            }
        };
        DesiredSubscription desired = new DesiredSubscription(
                new DesiredSubscription.Name("furrow farm", IdPartition.ALL, EVERYWHERE),
                Subject.ANY,
                new NotificationContent(List.of("*", "dateModified"), "normalized", false),
                new Target("http://127.0.0.1:1/", Map.of(), Optional.empty()),
                DesiredSubscription.Throttling.EVERY_CHANGE);
        RepairSettings settings = new RepairSettings(
                Path.of(args[0]),
                Duration.ofSeconds(1),
                Mode.INITIAL,
                new Reading(500, 16L * MIB, EventTimeRule.within(Duration.ofDays(10_000)), List.of()),
                new Deletions(BOUND, Duration.ofHours(1)));
        try (SubscriptionReconciler reconciler = new SubscriptionReconciler(
                client::send,
                desired,
                settings,
                new SubscriptionReconciler.SharedServices(live, output, new Ledger()))) {
            reconciler.poll();
            System.out.printf("repaired %d dead %d%n", counts[0], counts[1]);
            for (int i = 0; i < 400_000; i++) {
                note(live, reconciler, "urn:ngsi-ld:Device:" + i);
                live.arrived("forged".repeat(20) + i);
            }
            live.arrived("ffffffffffffffffffffffff");
            System.out.printf(
                    "known %d arrived %d%n", reconciler.knownEntities(), live.arrivedOf("ffffffffffffffffffffffff"));
        }
        server.close();
    }

    private static void note(RecordTracker live, SubscriptionReconciler reconciler, String id) throws IOException {
        FiwareScope place = new FiwareScope("agri", "/");
        live.append(
                "s",
                List.of(new TrackedRecord(place.identity("T", id), "id" + id, Optional.of(T), false)),
                () -> Optional.of(CompletableFuture.completedFuture(null)));
        reconciler.note(place.identity("T", id), false);
    }

    private static void answer(HttpExchange exchange) throws IOException {
        String path = exchange.getRequestURI().getRawPath() + "?"
                + Optional.ofNullable(exchange.getRequestURI().getRawQuery()).orElse("");
        exchange.getRequestBody().readAllBytes();
        try (exchange) {
            if (exchange.getRequestMethod().equals("POST")) {
                exchange.getResponseHeaders().add("Location", "/v2/subscriptions/ffffffffffffffffffffffff");
                exchange.sendResponseHeaders(201, -1);
                return;
            }
            exchange.sendResponseHeaders(200, 0);
            try (OutputStream body = exchange.getResponseBody()) {
                body.write('[');
                if (path.startsWith("/v2/entities")) {
                    entities(path, body);
                }
                body.write(']');
            } catch (IOException e) {
                // the client has had enough
            }
        }
    }

    /** Images of 1 MiB, a text that is too long, and a list whose tree takes much more than its text. */
    private static void entities(String path, OutputStream body) throws IOException {
        int first = 0;
        int limit = IMAGES + 2;
        Matcher from = FROM.matcher(path);
        if (from.find()) {
            Instant time = Instant.parse(java.net.URLDecoder.decode(from.group(1), UTF_8));
            first = (int) Math.max(0, Duration.between(T, time).toMillis());
        }
        Matcher number = NUMBER.matcher(path);
        while (number.find()) {
            int value = Integer.parseInt(number.group(2));
            if (number.group(1).equals("limit")) {
                limit = value;
            } else {
                first += value;
            }
        }
        Matcher id = ID.matcher(path);
        if (id.find()) {
            first = Integer.parseInt(id.group(1));
            limit = 1;
        }
        for (int i = first; i < Math.min(first + limit, IMAGES + 2); i++) {
            body.write((i > first ? "," : "").getBytes(UTF_8));
            entity(i, path.contains("attrs=*"), body);
        }
    }

    private static void entity(int number, boolean whole, OutputStream body) throws IOException {
        String date = "{\"type\": \"DateTime\", \"value\": \"" + T.plusMillis(number) + "\", \"metadata\": {}}";
        String head = "{\"id\": \"e%d\", \"type\": \"Camera\", \"dateModified\": %s, \"dateCreated\": %s"
                .formatted(number, date, date);
        body.write(head.getBytes(UTF_8));
        if (whole) {
            boolean isList = number == IMAGES + 1;
            int bytes = number == IMAGES ? 9 * MIB : isList ? 4 * MIB : MIB;
            body.write((", \"v\": {\"type\": \"Text\", \"metadata\": {}, \"value\": " + (isList ? "[" : "\""))
                    .getBytes(UTF_8));
            byte[] part = (isList ? "[],".repeat(1000) : "iVBORw0KGgo=".repeat(100)).getBytes(UTF_8);
            for (int written = 0; written < bytes; written += part.length) {
                body.write(part);
            }
            body.write((isList ? "0]}" : "\"}").getBytes(UTF_8));
        }
        body.write('}');
    }
}
