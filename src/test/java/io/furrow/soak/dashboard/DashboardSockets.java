package io.furrow.soak.dashboard;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.Properties;
import java.util.concurrent.Callable;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicLong;
import java.util.concurrent.locks.LockSupport;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;

import io.furrow.control.ControlSettings;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.kafka.Readiness;
import io.furrow.model.topic.Topics;
import io.furrow.soak.control.JavaProcess;
import io.furrow.soak.control.KafkaProcess;
import io.furrow.soak.control.Until;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * Opens many sockets of which some hardly read, then many that are opened and dropped: no socket delays another, and
 * all resources are released.
 */
public final class DashboardSockets implements AutoCloseable {
    private static final String TOPIC = "data.farm.realtime.weeding";
    private static final String OPEN = "furrow_dashboard_streams{kind=\"socket\"}";
    private static final String TOO_SLOW = "furrow_dashboard_streams_closed_total{reason=\"too-slow\"}";
    /** A connection that was cut while it opened is detected after its idle timeout, a minute. */
    private static final Duration TIMEOUT = Duration.ofSeconds(120);

    private static final int DROPPERS = 16;
    private static final long SETTLE_NANOS = Duration.ofSeconds(5).toNanos();
    private static final long STEP_NANOS = Duration.ofSeconds(2).toNanos();
    private static final int MAX_POOLED_THREADS = 96;
    private static final int WARM_UP_DROPS = 300;
    private static final int ROUNDS = 4;
    private static final double MAX_GROWTH = 1.1;

    private final Settings settings;
    private final Properties client = new Properties();
    private final KafkaProcess kafka;
    private final RestApi api;
    private final DashboardProcess dashboard;
    private final KafkaProducer<String, byte[]> producer;
    private final HttpClient http =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private final List<String> faults = new ArrayList<>();
    private final AtomicLong produced = new AtomicLong();
    private volatile boolean producing = true;

    /**
     * Size of a run.
     *
     * @param sockets of which {@code slow} read a frame every two seconds, half of these with {@code mode=latest}
     * @param rate records per second
     * @param drops sockets that are opened and dropped
     * @param p99 accepted for the other sockets
     */
    record Settings(Path folder, Duration duration, int sockets, int slow, int rate, int drops, Duration p99) {}

    private DashboardSockets(Settings settings) throws Exception {
        this.settings = settings;
        kafka = new KafkaProcess(settings.folder());
        kafka.start();
        client.setProperty("bootstrap.servers", kafka.bootstrapServers());
        api = RestApi.start(ControlSettings.of(client), RestSettings.on(0), new Readiness(Clock.systemUTC()));
        try (Admin admin = Admin.create(client)) {
            admin.createTopics(List.of(
                            new NewTopic(TOPIC, Optional.of(1), Optional.empty()),
                            new NewTopic(Topics.LATEST, Optional.of(1), Optional.empty())))
                    .all()
                    .get();
        }
        producer = new KafkaProducer<>(client, new StringSerializer(), new ByteArraySerializer());
        dashboard = new DashboardProcess(settings.folder(), kafka.bootstrapServers(), api.uri());
    }

    /** Arguments: folder, seconds, sockets, slow, records per second, drops, p99 in ms. */
    public static void main(String... args) throws Exception {
        JavaProcess.killChildrenAtExit();
        List<String> faults = run(new Settings(
                Path.of(args[0]),
                Duration.ofSeconds(Long.parseLong(args[1])),
                Integer.parseInt(args[2]),
                Integer.parseInt(args[3]),
                Integer.parseInt(args[4]),
                Integer.parseInt(args[5]),
                Duration.ofMillis(Long.parseLong(args[6]))));
        faults.forEach(System.out::println);
        System.exit(faults.isEmpty() ? 0 : 1);
    }

    /** Runs and returns the faults as sentences. */
    static List<String> run(Settings settings) throws Exception {
        try (DashboardSockets soak = new DashboardSockets(settings)) {
            return soak.run();
        }
    }

    private List<String> run() throws Exception {
        Thread load = new Thread(this::produce, "load");
        load.setDaemon(true);
        load.start();
        open(settings.sockets(), true, "all").forEach(SoakSocket::drop); // fills pools and caches
        drop(Math.max(WARM_UP_DROPS, settings.drops() / 10));
        awaitClosed(); // one address may not have further sockets beside these
        read(Duration.ofSeconds(Math.min(20, settings.duration().toSeconds())));
        long bytes = awaitClosed();
        long threads = dashboard.threads();
        print("before: %.1f MB live, %d threads".formatted(bytes / 1e6, threads));
        read(settings.duration());
        after("after the slow ones", bytes, threads);
        for (int round = 1; round <= ROUNDS; round++) { // a leak per socket would add up
            long startedAt = System.nanoTime();
            drop(settings.drops() / ROUNDS);
            print("%d sockets were opened and dropped in %d s"
                    .formatted(settings.drops() / ROUNDS, (System.nanoTime() - startedAt) / 1_000_000_000));
            after("after round %d of dropped ones".formatted(round), bytes, threads);
        }
        producing = false;
        load.join();
        return faults;
    }

    private void produce() {
        long startedAt = System.nanoTime();
        String filler = "x".repeat(300);
        while (producing) {
            long due = (System.nanoTime() - startedAt) * settings.rate() / 1_000_000_000L;
            while (produced.get() < due) {
                long n = produced.getAndIncrement();
                String value =
                        "{\"sent\":%d,\"n\":%d,\"filler\":\"%s\"}".formatted(System.currentTimeMillis(), n, filler);
                producer.send(new ProducerRecord<>(TOPIC, "device-" + n % 50, value.getBytes(UTF_8)));
            }
            LockSupport.parkNanos(1_000_000);
        }
    }

    private List<SoakSocket> open(int count, boolean reads, String mode) throws Exception {
        List<SoakSocket> opened = new ArrayList<>();
        for (int i = 0; i < count; i++) {
            opened.add(SoakSocket.open(http, register(TOPIC + "?format=record&mode=" + mode), reads));
        }
        return opened;
    }

    private URI register(String topicAndQuery) throws IOException {
        HttpResponse<String> answer = dashboard.get("/api/register/" + topicAndQuery);
        if (answer.statusCode() != 200) {
            throw new IOException("register answers %d %s".formatted(answer.statusCode(), answer.body()));
        }
        String path = answer.body().replaceAll(".*\"socket\" *: *\"([^\"]+)\".*", "$1");
        return URI.create(dashboard.uri().toString().replace("http:", "ws:") + path);
    }

    private void read(Duration duration) throws Exception {
        List<SoakSocket> quick = open(settings.sockets() - settings.slow(), true, "all");
        List<SoakSocket> all = open(settings.slow() / 2, false, "all");
        List<SoakSocket> latest = open(settings.slow() - settings.slow() / 2, false, "latest");
        LockSupport.parkNanos(SETTLE_NANOS);
        quick.forEach(SoakSocket::resetCounts);
        double closedBefore = dashboard.metric(TOO_SLOW);
        long before = produced.get();
        long end = System.nanoTime() + duration.toNanos();
        while (System.nanoTime() < end) {
            LockSupport.parkNanos(STEP_NANOS);
            all.forEach(SoakSocket::readFrame);
            latest.forEach(SoakSocket::readFrame);
            int removed = settings.sockets() - (int) dashboard.metric(OPEN);
            for (int i = 0; i < removed; i++) { // replaces closed sockets
                all.remove(0).drop();
                all.addAll(open(1, false, "all"));
            }
        }
        long expected = produced.get() - before;
        long loaded = dashboard.liveBytes();
        long[] ages = new long[SoakSocket.MAX_AGE + 1];
        quick.forEach(socket -> socket.addTo(ages));
        long p99 = quantile(ages, 0.99);
        print("%d sockets that read, %d records each: p50 %d ms, p95 %d ms, p99 %d ms, max %d ms"
                .formatted(quick.size(), expected, quantile(ages, 0.5), quantile(ages, 0.95), p99, quantile(ages, 1)));
        print("%d slow ones: %.0f were closed, %.0f records merged; %.1f MB live"
                .formatted(
                        settings.slow(),
                        dashboard.metric(TOO_SLOW) - closedBefore,
                        dashboard.metric("furrow_dashboard_records_merged_total"),
                        loaded / 1e6));
        check(p99 <= settings.p99().toMillis(), "p99 was %d ms", p99);
        for (SoakSocket socket : quick) {
            check(socket.end() == null, "a socket that reads was closed: %s", socket.end());
            check(socket.missing() == 0, "a socket that reads has %d gaps", socket.missing());
            check(
                    socket.records() >= expected * 0.98,
                    "a socket that reads has %d records of %d",
                    socket.records(),
                    expected);
        }
        quick.forEach(SoakSocket::drop);
        all.forEach(SoakSocket::drop);
        latest.forEach(SoakSocket::drop);
    }

    private static long quantile(long[] ages, double share) {
        long total = java.util.Arrays.stream(ages).sum();
        long seen = 0;
        for (int i = 0; i < ages.length; i++) {
            seen += ages[i];
            if (seen > 0 && seen >= total * share) {
                return i;
            }
        }
        return ages.length;
    }

    /**
     * Opens and drops sockets on several threads; every tenth requests the initial state, and some are cut while they
     * open.
     */
    private void drop(int count) throws Exception {
        ExecutorService threads = Executors.newFixedThreadPool(DROPPERS);
        try {
            List<Future<Void>> results = new ArrayList<>();
            for (int i = 0; i < count; i++) {
                String query = i % 10 == 0 ? "&prime=true&mode=latest" : "";
                results.add(threads.submit((Callable<Void>) () -> {
                    SoakSocket.open(http, register(TOPIC + "?format=record" + query), true)
                            .drop();
                    return null;
                }));
            }
            int failed = 0;
            String why = "";
            for (Future<Void> each : results) {
                try {
                    each.get();
                } catch (ExecutionException e) {
                    failed++;
                    why = String.valueOf(e.getCause());
                }
            }
            check(failed == 0, "%d sockets could not be opened: %s", failed, why);
        } finally {
            threads.shutdownNow();
        }
    }

    /** Waits until no stream is open, and returns the live bytes. */
    private long awaitClosed() throws IOException, InterruptedException, TimeoutException {
        boolean free = Until.within(
                TIMEOUT,
                () -> dashboard.metric(OPEN) == 0
                        && dashboard.metric("furrow_dashboard_streams{kind=\"events\"}") == 0
                        && dashboard.metric("furrow_dashboard_topics") == 0);
        check(free, "%.0f streams are still open", dashboard.metric(OPEN));
        LockSupport.parkNanos(SETTLE_NANOS);
        return dashboard.liveBytes();
    }

    private void after(String when, long bytesBefore, long threadsBefore) throws Exception {
        long bytes = awaitClosed();
        boolean fewThreads = Until.within(TIMEOUT, () -> threads() <= threadsBefore + 4);
        print("%s: %.1f MB live, %d threads, %d of the pools"
                .formatted(when, bytes / 1e6, threads(), dashboard.pooledThreads()));
        check(bytes <= bytesBefore * MAX_GROWTH, "%s %d bytes are live, before it were %d", when, bytes, bytesBefore);
        check(
                dashboard.pooledThreads() <= MAX_POOLED_THREADS,
                "%s the pools have %d threads",
                when,
                dashboard.pooledThreads());
        check(fewThreads, "%s there are %d threads, before there were %d", when, threads(), threadsBefore);
        check(dashboard.isAlive(), "%s the dashboard has ended", when);
    }

    private long threads() {
        try {
            return dashboard.threads();
        } catch (IOException e) {
            throw new IllegalStateException(e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IllegalStateException(e);
        }
    }

    private void check(boolean holds, String fault, Object... values) {
        if (!holds) {
            faults.add(fault.formatted(values));
        }
    }

    private static void print(String line) {
        System.out.println(line);
    }

    @Override
    public void close() {
        producing = false;
        producer.close(Duration.ofSeconds(2));
        dashboard.close();
        api.close();
        kafka.close();
    }
}
