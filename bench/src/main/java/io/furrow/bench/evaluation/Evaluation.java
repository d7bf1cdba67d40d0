package io.furrow.bench.evaluation;

import java.io.PrintWriter;
import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.concurrent.atomic.LongAdder;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.bench.arrival.TopicReader;
import io.furrow.bench.evaluation.Sweep.Point;
import io.furrow.bench.load.LoadMeasurement;
import io.furrow.bench.load.LoadReport;
import io.furrow.bench.whole.ThreadTimes;
import io.furrow.cli.CommandException;
import io.furrow.launcher.Progress;
import io.furrow.launcher.RestClient;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.launcher.suite.Suite;
import io.furrow.launcher.suite.SuiteSettings;
import io.furrow.model.topic.Topics;
import io.furrow.simulators.load.LoadPlan;

/** Runs sweeps through a suite in this JVM, one suite for each sweep, with the stand-ins of context broker and IoT Agent. */
public final class Evaluation {
    private static final String DOMAIN = "evaluation";
    private static final Duration WARM_UP = Duration.ofSeconds(20);
    /** A start, a warm-up, and what is waited for before and after each point. */
    private static final long SECONDS_A_SWEEP = 45;

    private static final long SECONDS_A_POINT = 6;

    private final String commit;
    private final Duration lasting;
    private final EvaluationResults results;
    private final PrintWriter out;

    /** @param lasting how long each point is measured */
    public Evaluation(String commit, Duration lasting, EvaluationResults results, PrintWriter out) {
        this.commit = commit;
        this.lasting = lasting;
        this.results = results;
        this.out = out;
    }

    /** Measures what the results do not have yet. */
    public void run(List<Sweep> sweeps) throws Exception {
        for (Sweep sweep : sweeps) {
            List<Point> missing = missing(sweep);
            if (!missing.isEmpty()) {
                out.printf(
                        "%s: %d points, some %d min of %d in all%n",
                        sweep.title(), missing.size(), minutes(List.of(sweep)), minutes(sweeps));
                out.flush();
                run(sweep, missing);
            }
        }
    }

    private List<Point> missing(Sweep sweep) {
        return sweep.points().stream()
                .filter(point -> !results.has(commit, point, lasting.toSeconds()))
                .toList();
    }

    private long minutes(List<Sweep> sweeps) {
        long seconds = 0;
        for (Sweep sweep : sweeps) {
            int points = missing(sweep).size();
            seconds += points == 0 ? 0 : SECONDS_A_SWEEP + points * (lasting.toSeconds() + SECONDS_A_POINT);
        }
        return (seconds + 59) / 60;
    }

    private void run(Sweep sweep, List<Point> points) throws Exception {
        try (RunDirectory directory = RunDirectory.open(null);
                Suite suite = Suite.start(SuiteSettings.onFreePorts("10s"), directory, new Progress(out))) {
            LoadMeasurement measurement = new LoadMeasurement(
                    suite.devices(), suite.kafka().clientProperties(), line -> progress("    " + line));
            measurement.run(new LoadPlan(25, Duration.ofMillis(200), 1_000, WARM_UP, DOMAIN, "warmup"));
            int copies = 1;
            for (Point point : points) {
                for (; copies < point.copies(); copies++) {
                    subscribeAgain(suite, copies);
                }
                PointResult result = measure(suite, measurement, point);
                results.add(result);
                print(result);
            }
        }
    }

    private PointResult measure(Suite suite, LoadMeasurement measurement, Point point) throws Exception {
        LoadPlan plan = point.plan(lasting, DOMAIN);
        LongAdder notified = new LongAdder();
        ThreadTimes before = ThreadTimes.of(ProcessHandle.current().pid());
        long from = System.nanoTime();
        LoadReport load;
        // Only where there are copies: another reader of large messages would change what is measured.
        if (point.sweep() == Sweep.SUBSCRIPTIONS) {
            try (TopicReader raw = new TopicReader(
                    suite.kafka().clientProperties(),
                    Topics.RAW,
                    Map.of(),
                    records -> records.forEach(record -> count(record, plan, notified)))) {
                raw.start();
                load = measurement.run(plan);
            }
        } else {
            load = measurement.run(plan);
            notified.add(load.delivered());
        }
        double nanos = System.nanoTime() - from;
        Map<String, Double> cores = new HashMap<>();
        ThreadTimes.of(ProcessHandle.current().pid())
                .since(before)
                .byRole()
                .forEach((role, time) -> cores.put(role, time / nanos));
        return PointResult.of(commit, point, load, notified.sum(), cores);
    }

    /** Provisioning is notified of too, without a payload. */
    private static void count(ConsumerRecord<byte[], byte[]> record, LoadPlan plan, LongAdder notified) {
        String entity = new String(record.key(), StandardCharsets.UTF_8);
        String value = new String(record.value(), StandardCharsets.UTF_8);
        if (entity.contains(":" + plan.mission() + "-") && value.contains("\"Payload\"")) {
            notified.increment();
        }
    }

    /** The source's own subscription a second time. */
    private static void subscribeAgain(Suite suite, int copy) {
        RestClient rest = new RestClient();
        URI subscriptions = suite.contextBroker().resolve("/v2/subscriptions");
        Map<String, String> tenant = Map.of("fiware-service", suite.fiwareService());
        JsonNode own = rest.get(subscriptions, tenant).body().path(0);
        ObjectNode again = ((ObjectNode) own.deepCopy()).put("description", "copy " + copy);
        again.retain("description", "subject", "notification");
        ((ObjectNode) again.get("notification"))
                .remove(List.of(
                        "timesSent",
                        "lastNotification",
                        "lastSuccess",
                        "lastSuccessCode",
                        "lastFailure",
                        "lastFailureReason",
                        "failsCounter"));
        RestClient.Answer answer = rest.send("POST", subscriptions, tenant, again);
        if (!answer.isSuccess()) {
            throw new CommandException("The context broker refused a copy of the subscription: " + answer.body());
        }
    }

    private void print(PointResult result) {
        out.printf(
                Locale.ROOT,
                "  %-18s %6.0f/s  sent %6d  delivered %.4f  duplicated %d  reordered %d  ms p50 %d p99 %d max %d  %s%n",
                result.point().title(),
                result.point().rate(),
                result.sent(),
                result.deliveredRatio(),
                result.duplicated(),
                result.reordered(),
                result.endToEnd().p50(),
                result.endToEnd().p99(),
                result.endToEnd().max(),
                result.busiest());
        out.flush();
    }

    private void progress(String line) {
        out.println(line);
        out.flush();
    }
}
