package io.furrow.soak.source;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.ThreadLocalRandom;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.process.Ports;
import io.furrow.soak.control.Http;
import io.furrow.soak.control.Until;

/** The workers of a Connect group, each with its own disk and address, and a source with three tasks. */
final class SourceGroup implements AutoCloseable {
    static final int TASKS = 3;

    private static final Duration TIMEOUT = Duration.ofSeconds(120);
    /** The tasks of a killed worker are reassigned after the session timeout. */
    private static final String[] SETTINGS = """
            session.timeout.ms=6000 heartbeat.interval.ms=2000 config.providers=env
            config.providers.env.class=org.apache.kafka.common.config.provider.EnvVarConfigProvider""".split("\\s+");

    private final Path folder;
    private final String bootstrapServers;
    private final boolean exactlyOnce;
    private final List<Member> members = new ArrayList<>();
    private final List<Member> departed = new ArrayList<>();

    SourceGroup(Path folder, String bootstrapServers, boolean exactlyOnce) {
        this.folder = folder;
        this.bootstrapServers = bootstrapServers;
        this.exactlyOnce = exactlyOnce;
    }

    /** A worker. @param port of the first task; task i listens on port + i */
    record Member(String name, Path disk, int port, WorkerProcess process, WorkerGauges gauges) {
        /** Whether one of the tasks listens on this port when it runs here. */
        boolean has(int listener) {
            return listener >= port && listener < port + TASKS;
        }

        @Override
        public String toString() {
            return name;
        }
    }

    /** Starts a worker with a new or existing disk, at an address of its own. */
    Member join(String name, String disk) throws IOException {
        Path path = folder.resolve(disk).toAbsolutePath();
        int port = freePorts();
        Map<String, String> environment =
                Map.of("FURROW_JOURNAL", path.resolve("journal").toString(), "FURROW_PORT", Integer.toString(port));
        WorkerProcess process = new WorkerProcess(
                folder.resolve(name), bootstrapServers, environment, SourceWorker.settings(exactlyOnce, SETTINGS));
        Member member = new Member(name, path, port, process, new WorkerGauges(process.jmxPort()));
        members.add(member);
        departed.removeIf(other -> other.disk().equals(path));
        process.start();
        return member;
    }

    /** Starts the same worker again, with its disk and address. */
    void restart(Member member) throws IOException {
        member.process().start();
        members.add(member);
        departed.remove(member);
    }

    void kill(Member member) throws InterruptedException {
        members.remove(member);
        departed.add(member);
        member.process().kill();
    }

    void stop(Member member) {
        members.remove(member);
        departed.add(member);
        member.process().close();
    }

    List<Member> members() {
        return List.copyOf(members);
    }

    /** Workers that were killed or stopped, and whose disk no other worker uses. */
    List<Member> departed() {
        return List.copyOf(departed);
    }

    void createSource(URI contextBroker, String publicUrl) {
        ObjectNode config = SourceWorker.config(exactlyOnce)
                .put("tasks.max", Integer.toString(TASKS))
                .put("listen.port", "${env:FURROW_PORT}")
                .put("journal.dir", "${env:FURROW_JOURNAL}")
                .put("public.url", publicUrl)
                .put("context.broker.url", contextBroker.toString())
                .put("subscription.types", NumberedChange.TYPE)
                .put("subscription.check.interval.ms", "2000");
        members.get(0).process().createConnector(SourceWorker.CONNECTOR, config);
    }

    void pause() {
        change("pause");
    }

    void resume() {
        change("resume");
    }

    private void change(String verb) {
        ObjectNode empty = JsonNodeFactory.instance.objectNode();
        Until.isTrue(
                verb,
                TIMEOUT,
                () -> Http.send("PUT", connectors("/" + SourceWorker.CONNECTOR + "/" + verb), NgsiJson.write(empty))
                                        .join()
                                        .status()
                                / 100
                        == 2);
        String state = verb.equals("pause") ? "PAUSED" : "RUNNING";
        Until.isTrue(
                "all tasks " + state,
                TIMEOUT,
                () -> tasks(state).values().stream().mapToInt(Integer::intValue).sum() == TASKS);
    }

    private URI connectors(String path) {
        return members.get(0).process().connectors(path);
    }

    /** Returns once all tasks run, and each worker has one. */
    void awaitTasks() {
        Until.isTrue("all tasks run on " + members, TIMEOUT, () -> {
            var shown = shown().values();
            return tasks("RUNNING").values().stream()
                                    .mapToInt(Integer::intValue)
                                    .sum()
                            == TASKS
                    && shown.stream().mapToInt(WorkerGauges.Shown::tasks).sum() == TASKS
                    && shown.stream().allMatch(one -> one.tasks() > 0);
        });
    }

    private Map<String, Integer> tasks(String state) {
        Map<String, Integer> tasks = new TreeMap<>();
        JsonNode status =
                Http.get(connectors("/" + SourceWorker.CONNECTOR + "/status")).body();
        for (JsonNode task : status.path("tasks")) {
            if (task.path("state").asText().equals(state)) {
                tasks.merge(task.path("worker_id").asText(), 1, Integer::sum);
            }
        }
        return tasks;
    }

    /** The current gauges of each worker. */
    Map<String, WorkerGauges.Shown> shown() {
        Map<String, WorkerGauges.Shown> shown = new TreeMap<>();
        members().forEach(member -> shown.put(member.name(), member.gauges().read()));
        return shown;
    }

    /** The number of journals with offsets in Connect. */
    int journalsInOffsets() {
        return Http.get(connectors("/" + SourceWorker.CONNECTOR + "/offsets"))
                .body()
                .path("offsets")
                .size();
    }

    /** Finds free ports below those that operating systems assign to clients. */
    private int freePorts() {
        while (true) {
            int first = ThreadLocalRandom.current().nextInt(20_000, 32_000);
            boolean others = members.stream().anyMatch(member -> Math.abs(member.port() - first) < TASKS);
            if (!others && IntStream.range(first, first + TASKS).allMatch(Ports::isFree)) {
                return first;
            }
        }
    }

    @Override
    public void close() {
        members().forEach(this::stop);
    }
}
