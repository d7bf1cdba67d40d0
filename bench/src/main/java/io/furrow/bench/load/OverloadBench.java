package io.furrow.bench.load;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.Properties;
import java.util.concurrent.TimeUnit;

import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Figures;
import io.furrow.bench.frame.ProcessStatus;
import io.furrow.bench.frame.TopicReader;
import io.furrow.launcher.suite.Suite;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.simulators.load.LoadFleet;
import io.furrow.simulators.load.LoadPlan;

/** {@code ./furrow bench overload}. Sender, suite and reader share the machine, its clock and the heap. */
@Command(
        name = "overload",
        description =
                "Sends the embedded suite a rate, half of it, twice as much and half of it again, and prints what arrived, and how"
                        + " what waited drained. Exit code 1 where a message is missing.")
public final class OverloadBench extends Benchmark {
    private static final int PAYLOAD = 1_000;
    /** Of a device at the rate; other rates have other periods. */
    private static final int PERIOD_MS = 200;

    private static final double MEGABYTE = 1_000_000;
    private static final Duration DRAIN_STEP = Duration.ofSeconds(2);
    private static final Duration MAX_DRAIN = Duration.ofMinutes(5);
    /** After the backlog has drained, until delays count again. */
    private static final Duration RECOVERY = Duration.ofSeconds(5);

    @Option(
            names = "--rate",
            paramLabel = "N",
            description =
                    "Messages of 1 kB a second, a multiple of 5: the highest at which p99 stays below 1 s. " + DEFAULT)
    private int rate = 1250;

    @Option(names = "--seconds", paramLabel = "S", description = "Of each rate. " + DEFAULT)
    private long seconds = 20;

    @Option(names = "--bursts", description = "Twice the rate comes as four times the rate in every other second.")
    private boolean bursts;

    private final Arrivals arrivals = new Arrivals();
    private Suite suite;
    private long sent;

    @Override
    public Integer call() throws Exception {
        return onSuite(null, started -> {
            suite = started;
            return measure();
        });
    }

    private int measure() throws Exception {
        Properties kafka = suite.kafka().clientProperties();
        Duration stage = Duration.ofSeconds(seconds);
        String topic = new LoadMeasurement(suite.devices(), kafka, this::say).prepare(load(1, stage));
        try (TopicReader reader = TopicReader.fromEnd(kafka, LoadMeasurement.FETCHING, topic)) {
            reader.follow(arrivals::add);
            for (double share : new double[] {0.25, 0.5, 1}) {
                send(share, stage);
            }
            awaitAll();
            say("the rate");
            Arrivals.Interval knee = send(1, stage);
            long kneeHeap = ProcessStatus.heapAfterCollection();
            awaitAll();
            say("half of it");
            Arrivals.Interval before = send(0.5, stage);
            awaitAll();
            say("twice as much");
            Arrivals.Interval over = bursts ? bursts() : send(2, stage);
            long pending = pending(suite.listener());
            long overHeap = ProcessStatus.heapAfterCollection();
            say("half of it again");
            long usual = arrivals.mostWaiting(before);
            drain(usual);
            send(0.5, RECOVERY);
            Arrivals.Interval after = send(0.5, stage);
            awaitAll();
            Figures figures = new Figures("");
            arrivals.addTo(figures, rate + " a second", knee);
            long p99Before = arrivals.addTo(figures, "half of it", before);
            arrivals.addTo(figures, bursts ? "twice as much, in bursts" : "twice as much", over);
            long p99After = arrivals.addTo(figures, "half of it, 5 s after", after);
            print(figures);
            printDrain(over, usual);
            print(
                    "heap after a collection: %.0f MB at the rate, %.0f MB under overload, %.2f; p99 after to before: %.2f%n",
                    kneeHeap / MEGABYTE,
                    overHeap / MEGABYTE,
                    (double) overHeap / kneeHeap,
                    (double) p99After / Math.max(1, p99Before));
            print("sent %d   delivered %d   repeats %d%n", sent, arrivals.distinct(), arrivals.repeats());
            print("/health under overload: %d records on the source's disk that Kafka does not have%n", pending);
            return arrivals.distinct() == sent ? 0 : 1;
        }
    }

    /** From the end of the overload, while half of the rate was sent. */
    private void printDrain(Arrivals.Interval over, long usual) {
        long drained = arrivals.waiting(over.to());
        long at = over.to();
        while (arrivals.waiting(at) > usual) {
            at += 100;
        }
        drained -= arrivals.waiting(at);
        double lasting = (at - over.to()) / 1000.0;
        print(
                "arrived under overload: %.2f of the rate; drained %d messages in %.1f s, %.2f of the rate a second%n",
                arrivals.arrivedPerSecond(over) / rate, drained, lasting, lasting == 0 ? 0 : drained / lasting / rate);
    }

    /** @throws IOException if the backlog has not arrived after {@link #MAX_DRAIN} */
    private void drain(long usual) throws IOException, InterruptedException {
        long from = System.currentTimeMillis();
        while (sent - arrivals.distinct() > usual) {
            if (System.currentTimeMillis() - from > MAX_DRAIN.toMillis()) {
                throw new IOException(
                        "%d messages have not arrived after %s".formatted(sent - arrivals.distinct(), MAX_DRAIN));
            }
            send(0.5, DRAIN_STEP);
            say("%d wait".formatted(sent - arrivals.distinct()));
        }
    }

    /** The rate multiplied by the factor. */
    private LoadPlan load(double factor, Duration duration) {
        int devices = Math.max(1, rate * PERIOD_MS / 1000);
        Duration period = Duration.ofMillis(Math.round(PERIOD_MS / factor));
        return new LoadPlan(devices, period, PAYLOAD, duration, "bench", "overload");
    }

    private Arrivals.Interval send(double factor, Duration duration) throws IOException, InterruptedException {
        try (LoadFleet fleet = LoadFleet.start(suite.devices(), load(factor, duration))) {
            long from = System.currentTimeMillis();
            fleet.await();
            sent += fleet.acknowledged();
            return new Arrivals.Interval(from, System.currentTimeMillis());
        }
    }

    private Arrivals.Interval bursts() throws IOException, InterruptedException {
        long from = System.currentTimeMillis();
        for (long second = 0; second < seconds; second += 2) {
            send(4, Duration.ofSeconds(1));
            long next = from + (second + 2) * 1000;
            TimeUnit.MILLISECONDS.sleep(Math.max(0, next - System.currentTimeMillis()));
        }
        return new Arrivals.Interval(from, System.currentTimeMillis());
    }

    private void awaitAll() throws InterruptedException {
        long until = System.currentTimeMillis() + MAX_DRAIN.toMillis();
        while (arrivals.distinct() < sent && System.currentTimeMillis() < until) {
            TimeUnit.MILLISECONDS.sleep(100);
        }
    }

    /** Records on the source's disk, according to its {@code /health}. */
    private static long pending(URI listener) throws Exception {
        HttpRequest request =
                HttpRequest.newBuilder(listener.resolve("/health")).build();
        byte[] answer = HttpClient.newHttpClient()
                .send(request, HttpResponse.BodyHandlers.ofByteArray())
                .body();
        return NgsiJson.read(answer).required("pending").asLong();
    }
}
