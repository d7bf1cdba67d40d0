package io.furrow.soak.control;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentHashMap;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestReporter;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.Limits;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;
import io.furrow.soak.CommittedState;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/**
 * Sends a thousand extreme requests to a control plane with a heap of 512 MB; {@code -Dfurrow.seed=N} repeats those of
 * a seed.
 */
@Timeout(300)
@Tag("soak")
class ExtremeRequestsIT {
    private static final int REQUESTS = 1000;
    private static final int MAX_PENDING = 50;
    private static final Duration TIMEOUT = Duration.ofSeconds(90);

    private final Map<String, Http.Answer> overRest = new ConcurrentHashMap<>();
    private final List<AutoCloseable> parts = new ArrayList<>();
    private EmbeddedKafka kafka;
    private ControlProcess control;
    private RequestSender sender;
    private AnswerLog answers;
    private int ordinary;

    @BeforeEach
    void start(@TempDir Path directory) throws Exception {
        kafka = part(EmbeddedKafka.start(directory.resolve("kafka")));
        FiwareStandIn fiware = part(FiwareStandIn.start(FiwareSettings.httpOnly()));
        control = part(new ControlProcess(
                directory,
                "control",
                new ControlProcess.Settings(
                        kafka.bootstrapServers(), "512m", ControlPlaneOptions.provisioning(directory, fiware))));
        control.start();
        await().atMost(TIMEOUT).until(() -> !control.isAlive() || control.isReady());
        assertThat(control.isAlive()).as("it started").isTrue();
        sender = part(new RequestSender(kafka.bootstrapServers()));
        answers = part(new AnswerLog(kafka.bootstrapServers()));
        part(new AcceptingHost(kafka.bootstrapServers(), sender));
    }

    private <T extends AutoCloseable> T part(T part) {
        parts.add(part);
        return part;
    }

    @AfterEach
    void stop() throws Exception {
        for (int i = parts.size(); i > 0; i--) {
            parts.get(i - 1).close();
        }
    }

    @Test
    void answersEachRequestOnceAndStaysReady(TestReporter reporter) throws Exception {
        long seed = Long.getLong("furrow.seed", System.nanoTime());
        reporter.publishEntry("seed", Long.toString(seed));
        List<ControlRequest> requests = requests(seed);

        send(requests);

        assertThat(faults(requests)).as("seed %d", seed).isEmpty();
        reporter.publishEntry("answers", counts().toString());
        assertThat(control.isAlive()).isTrue();
        await().atMost(TIMEOUT).until(control::isReady);
        control.readiness()
                .path("parts")
                .forEach(part -> assertThat(part.path("state").asText()).isEqualTo("up"));
        runAnOrdinaryMission();
        assertThat(tooLarge()).isEmpty();
        assertThat(logged()).isEmpty();
    }

    private static List<ControlRequest> requests(long seed) {
        ExtremeRequests generator = new ExtremeRequests(seed);
        return Stream.generate(generator::next).limit(REQUESTS).toList();
    }

    /** Sends every other request over the API, the others over Kafka. */
    private void send(List<ControlRequest> requests) {
        List<CompletableFuture<?>> pending = new ArrayList<>();
        for (int i = 0; i < requests.size(); i++) {
            if (i % 2 == 0) {
                pending.add(call(requests.get(i), 5));
            } else {
                sender.write(requests.get(i));
            }
            if (pending.size() >= MAX_PENDING) {
                pending.remove(0).join();
            }
        }
        pending.forEach(CompletableFuture::join);
        sender.flush();
        await().atMost(TIMEOUT)
                .untilAsserted(() -> assertThat(requests.stream()
                                .filter(request -> isOverKafka(request)
                                        && answers.to(request.id()).isEmpty())
                                .map(ControlRequest::id))
                        .isEmpty());
    }

    /** Retries while the API answers 503. */
    private CompletableFuture<Http.Answer> call(ControlRequest request, int attempts) {
        return sender.call(control.api(), request).thenCompose(answer -> {
            if (answer.status() == 503 && attempts > 1) {
                return call(request, attempts - 1);
            }
            overRest.put(request.id(), answer);
            return CompletableFuture.completedFuture(answer);
        });
    }

    private boolean isOverKafka(ControlRequest request) {
        return !overRest.containsKey(request.id());
    }

    private List<String> faults(List<ControlRequest> requests) {
        List<String> faults = new ArrayList<>();
        for (ControlRequest request : requests) {
            List<CommandResult> results = answers.to(request.id());
            Http.Answer answer = overRest.get(request.id());
            boolean rejectedByApi = answer != null
                    && (answer.status() == 413
                            || answer.status() == 400 && request.members().has(ExtremeRequests.PADDING)
                            || answer.status() == 404 && request.command().equals("rotate-credentials"));
            boolean isValid = answer == null
                    || answer.status() / 100 == 2
                    || answer.status() / 100 == 4
                    || answer.status() == 507;
            if (!isValid || results.size() > 1 || results.isEmpty() && !rejectedByApi) {
                faults.add("%s %s %s: %s over REST, %s on the topic"
                        .formatted(request.topic(), request.command(), request.id(), answer, results));
            }
            results.stream()
                    .filter(each -> each.error().orElse("").equals("internal-error"))
                    .forEach(each -> faults.add(request.id() + ": " + each));
        }
        return faults;
    }

    private Map<String, Long> counts() {
        Map<String, Long> counts = new TreeMap<>();
        answers.answers()
                .values()
                .forEach(all ->
                        all.forEach(answer -> counts.merge(answer.error().orElse(answer.status()), 1L, Long::sum)));
        overRest.values().stream()
                .filter(answer -> answer.status() == 413)
                .forEach(answer -> counts.merge("413", 1L, Long::sum));
        return counts;
    }

    /** Stops and deletes the extreme missions first, which releases their quota. */
    private void runAnOrdinaryMission() throws Exception {
        await().atMost(TIMEOUT).until(() -> {
            for (String name : missions()) {
                String mission = "{'mission':'%s'}".formatted(name);
                ordinary(Topics.MISSION_MANAGER, "stop", mission);
                ordinary(Topics.MISSION_MANAGER, "delete", mission);
            }
            return missions().isEmpty();
        });
        assertThat(ordinary(Topics.DOMAIN_MANAGER, "create", "{'domain':'ordinary'}"))
                .isEqualTo(201);
        assertThat(
                        ordinary(
                                Topics.MISSION_MANAGER,
                                "start",
                                "{'mission':'m','domain':'ordinary','devices':[{'type':'Thermometer','count':2,'simulated':true}]}"))
                .isEqualTo(200);
        await().atMost(TIMEOUT).until(() -> state().equals("running"));
        assertThat(ordinary(Topics.MISSION_MANAGER, "stop", "{'mission':'m'}")).isEqualTo(200);
        await().atMost(TIMEOUT).until(() -> state().equals("stopped"));
    }

    private List<String> missions() {
        List<String> names = new ArrayList<>();
        Http.get(control.api().resolve("/api/missions"))
                .body()
                .forEach(mission -> names.add(mission.path("mission").asText()));
        return names;
    }

    /** @return the HTTP status */
    private int ordinary(String topic, String command, String members) throws Exception {
        ObjectNode json = (ObjectNode) NgsiJson.read(members.replace('\'', '"').getBytes(UTF_8));
        String id = "ordinary-" + ordinary++;
        return call(new ControlRequest(id, topic, command, json), 5).join().status();
    }

    private String state() {
        return Http.get(control.api().resolve("/api/missions/m"))
                .body()
                .at("/status/state")
                .asText();
    }

    /** Finds records above the control plane's limit; requests and dead letters have limits of their own. */
    private List<String> tooLarge() {
        List<String> tooLarge = new ArrayList<>();
        List<String> topics = CommittedState.topics(kafka.bootstrapServers()).stream()
                .filter(topic -> !topic.startsWith("__") && !topic.endsWith(".dead"))
                .toList();
        CommittedState.read(kafka.bootstrapServers(), topics, record -> {
            int size = Math.max(0, record.serializedKeySize()) + Math.max(0, record.serializedValueSize());
            boolean request = AnswerLog.MANAGERS.contains(record.topic());
            if (size > Limits.RECORD_BYTES && !request) {
                tooLarge.add("%s: %d bytes under %s".formatted(record.topic(), size, record.key()));
            }
        });
        return tooLarge;
    }

    /** Finds errors and restarts of parts. */
    private List<String> logged() throws Exception {
        try (Stream<String> lines = Files.lines(control.log())) {
            return lines.filter(line -> line.contains(" ERROR ")
                            || line.contains("started again")
                            || line.contains("begins anew")
                            || line.contains("OutOfMemory"))
                    .toList();
        }
    }
}
