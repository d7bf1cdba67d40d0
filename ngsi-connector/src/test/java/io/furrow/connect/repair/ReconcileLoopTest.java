package io.furrow.connect.repair;

import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.regex.Pattern;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.BrokerSettings;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.repair.RepairSettings.Mode;
import io.furrow.connect.subscription.DesiredSubscription;
import io.furrow.connect.subscription.DesiredSubscription.Name;
import io.furrow.connect.subscription.DesiredSubscription.Throttling;
import io.furrow.connect.subscription.IdPartition;
import io.furrow.connect.subscription.NotificationContent;
import io.furrow.connect.subscription.Subject;
import io.furrow.connect.subscription.Target;
import io.furrow.fiware.FiwareSettings;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Against the context broker of the simulators. Nothing listens where it notifies: each notification fails. */
class ReconcileLoopTest {
    private static final String NOBODY = "http://127.0.0.1:1/v2/notify";
    private static final NotificationContent CONTENT =
            new NotificationContent(List.of("*", "dateModified"), "normalized", false);

    @TempDir
    private Path folder;

    private final Broker broker = new Broker(FiwareSettings.httpOnly(), "agri");
    private final List<String> emitted = new CopyOnWriteArrayList<>();
    private final Ledger ledger = new Ledger();
    private final RecordTracker live = new RecordTracker(1 << 20);
    private volatile boolean room = true;
    private volatile Runnable failing = () -> {};
    private volatile Optional<Outcome> answer = Optional.empty();
    private ReconcileLoop loop;

    @AfterEach
    void stop() {
        if (loop != null) {
            loop.close();
        }
        broker.close();
    }

    @Test
    void makesOneSubscriptionHoweverOftenItStarts() {
        start(Mode.OFF);
        String id = subscription().path("id").asText();
        loop.close();

        start(Mode.OFF);

        assertThat(subscription().path("id").asText()).isEqualTo(id);
        assertThat(subscription().path("description").asText()).isEqualTo("furrow farm 1/1");
    }

    @Test
    void makesItAgainWhenItWasRemoved() {
        start(Mode.CHANGES);
        String id = subscription().path("id").asText();

        broker.send("DELETE", "/v2/subscriptions/" + id, "/#", "");

        await().until(() -> broker.subscriptions().size() == 1
                && !subscription().path("id").asText().equals(id));
        await().until(() -> ledger.gaps.sum() == 1);
    }

    @Test
    void saysWhereNotificationsGoAndThatTheyDoNotArrive() {
        start(Mode.OFF);

        broker.put("/", "e", "T", 1);

        await().untilAsserted(() -> {
            JsonNode told = ledger.toJson().get("subscriptions").get(0);
            assertThat(told.path("url").asText()).isEqualTo(NOBODY);
            assertThat(told.path("failsInARow").asLong()).isPositive();
        });
    }

    @Test
    void leavesTheSubscriptionToOthersWhileItRests() {
        start(Mode.CHANGES);
        loop.rest(true);
        await().until(() -> {
            broker.subscriptions()
                    .forEach(each -> broker.send(
                            "DELETE", "/v2/subscriptions/" + each.path("id").asText(), "/#", ""));
            return broker.subscriptions().isEmpty();
        });
        // A look that was under way may have made it once more; the next would again.
        await().during(Duration.ofSeconds(1)).until(() -> broker.subscriptions().isEmpty());

        loop.rest(false);

        await().until(() -> broker.subscriptions().size() == 1);
    }

    @ParameterizedTest
    @MethodSource("errors")
    void goesOnAfterAnyError(Runnable error) {
        start(Mode.OFF);

        failing = error;
        await().until(() -> gauge("subscriptionsOutOfSync") == 1);
        assertThat(ledger.toJson().get("subscriptions").toString()).contains("none of its business");
        failing = () -> {};

        await().until(() -> gauge("subscriptionsOutOfSync") == 0);
    }

    static Stream<Runnable> errors() {
        return Stream.of(
                () -> {
                    throw new IllegalStateException("none of its business");
                },
                () -> {
                    throw new LinkageError("none of its business");
                });
    }

    @Test
    void startsItAgainWhenItWasStoppedAndReadsWhatItMissed() {
        start(Mode.CHANGES);
        String path = "/v2/subscriptions/" + subscription().path("id").asText();
        broker.send("PATCH", path, "/#", "{\"status\": \"inactive\"}");
        broker.put("/a", "e1", "Probe", 1);

        await().until(() -> emitted.contains("/a e1 1"));

        assertThat(subscription().path("status").asText()).isEqualTo("active");
    }

    @Test
    void readsWhatCouldNotBeDeliveredOfItsOwnTypesOnly() {
        start(Mode.CHANGES);
        broker.put("/a", "e1", "Probe", 1);
        broker.put("/", "excluded", "Analytics:Collision", 1);

        await().until(() -> emitted.contains("/a e1 1"));

        assertThat(ledger.gaps.sum()).isPositive();
        broker.put("/b", "e1", "Probe", 2);
        await().until(() -> emitted.contains("/b e1 2"));
        assertThat(emitted).containsExactly("/a e1 1", "/b e1 2");
    }

    @Test
    void goesOnAfterARestartWhereItWasAndTellsWhatIsGone() {
        start(Mode.CHANGES);
        broker.put("/", "stays", "Probe", 1);
        broker.put("/a", "goes", "Probe", 1);
        await().until(() -> emitted.size() == 2);
        loop.close();
        broker.delete("/a", "goes");
        broker.put("/", "stays", "Probe", 2);
        broker.put("/", "new", "Probe", 3);
        emitted.clear();

        start(Mode.CHANGES);

        await().until(() -> emitted.size() == 3);
        assertThat(emitted).containsExactlyInAnyOrder("/ stays 2", "/ new 3", "/a goes deleted");
    }

    @Test
    void readsNothingForANewSubscriptionUnlessItIsAskedTo() {
        broker.put("/", "e1", "Probe", 1);

        start(Mode.CHANGES);

        await().until(() -> gauge("knownEntities") == 1);
        assertThat(emitted).isEmpty();
    }

    @Test
    void beginsWithEverythingWhenItIsAskedTo() {
        for (int i = 0; i < 25; i++) {
            broker.put("/", "e" + i, "Probe", i);
        }

        start(Mode.INITIAL);

        await().until(() -> emitted.size() >= 25);
        assertThat(emitted).hasSize(25).doesNotHaveDuplicates();
    }

    @Test
    void waitsForRoomAndStopsAllTheSame() {
        room = false;
        broker.put("/", "e1", "Probe", 1);
        start(Mode.INITIAL);
        await().during(Duration.ofMillis(300)).until(emitted::isEmpty);

        loop.close();
        await("the end of its thread")
                .until(() -> Thread.getAllStackTraces().keySet().stream()
                        .noneMatch(thread -> thread.getName().equals("furrow-reconcile")));

        room = true;
        start(Mode.INITIAL);
        await().until(() -> emitted.contains("/ e1 1"));
    }

    @Test
    void goesOnWithoutAContextBrokerAndComesBackToIt() {
        URI uri = broker.uri();
        start(Mode.CHANGES);
        broker.close();
        await().until(() -> gauge("subscriptionsOutOfSync") == 1);

        try (Broker again = new Broker(FiwareSettings.httpOnly().withContextBrokerPort(uri.getPort()), "agri")) {
            await().until(() -> again.subscriptions().size() == 1 && gauge("subscriptionsInSync") == 1);
        }
    }

    @Test
    void outlivesAContextBrokerThatAsksForAPauseOfAges() {
        answer = Optional.of(new Outcome.Unavailable("busy", Optional.of(Duration.ofDays(3_000_000)), null, 503));
        room = false;
        start(Mode.CHANGES);
        await().until(() -> gauge("subscriptionsOutOfSync") == 1);

        await().during(Duration.ofMillis(300))
                .until(() -> Thread.getAllStackTraces().keySet().stream()
                        .anyMatch(thread -> thread.getName().equals("furrow-reconcile")));
    }

    private void start(Mode mode) {
        DesiredSubscription desired = new DesiredSubscription(
                new Name("furrow farm", IdPartition.ALL, new FiwareScope("agri", "/#")),
                Subject.ANY,
                CONTENT,
                new Target(NOBODY, Map.of(), Optional.empty()),
                Throttling.EVERY_CHANGE);
        RepairSettings settings = new RepairSettings(
                folder,
                Duration.ofSeconds(1),
                mode,
                new RepairSettings.Reading(
                        4,
                        1 << 20,
                        EventTimeRule.within(Duration.ofMinutes(5)),
                        List.of(Pattern.compile("Analytics:.*"))),
                new RepairSettings.Deletions(1 << 20, Duration.ofMinutes(10)));
        BrokerClient client = new BrokerClient(BrokerSettings.of(broker.uri(), Duration.ofSeconds(5)));
        try {
            loop = ReconcileLoop.start(
                    request -> {
                        failing.run();
                        return answer.orElseGet(() -> client.send(request));
                    },
                    List.of(desired),
                    settings,
                    new SubscriptionReconciler.SharedServices(live, new Output(), ledger),
                    Duration.ofMillis(100));
        } catch (java.io.IOException e) {
            throw new java.io.UncheckedIOException(e);
        }
        if (room) {
            await().until(() -> gauge("subscriptionsInSync") > 0);
        }
    }

    /** Findings are texts here. */
    private final class Output implements RepairOutput {
        @Override
        public byte[] serialize(String subscription, MissedChange finding) {
            String text;
            if (finding instanceof MissedChange.Changed changed) {
                var event = changed.event();
                text = event.scope().servicePath() + " " + event.entity().id() + " "
                        + event.entity().value("t").map(JsonNode::asInt).orElse(-1);
            } else {
                var gone = ((MissedChange.Deleted) finding).deletion();
                text = gone.scope().servicePath() + " " + gone.entityId() + " deleted";
            }
            return text.getBytes(UTF_8);
        }

        @Override
        public Optional<CompletableFuture<Void>> append(List<byte[]> records) {
            if (!room) {
                return Optional.empty();
            }
            records.forEach(record -> emitted.add(new String(record, UTF_8)));
            return Optional.of(CompletableFuture.completedFuture(null));
        }
    }

    private long gauge(String name) {
        return ledger.all().stream()
                .filter(gauge -> gauge.name().equals(name))
                .reduce((first, second) -> second)
                .orElseThrow()
                .now();
    }

    private JsonNode subscription() {
        assertThat(broker.subscriptions()).hasSize(1);
        return broker.subscriptions().get(0);
    }
}
