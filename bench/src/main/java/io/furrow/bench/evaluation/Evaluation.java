package io.furrow.bench.evaluation;

import java.io.PrintWriter;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.atomic.LongAdder;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.bench.evaluation.Sweep.Point;
import io.furrow.bench.frame.ProcessStatus;
import io.furrow.bench.frame.TopicReader;
import io.furrow.bench.load.LoadMeasurement;
import io.furrow.bench.load.LoadReport;
import io.furrow.bench.whole.ThreadTimes;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.launcher.suite.Suite;
import io.furrow.launcher.suite.SuiteSettings;
import io.furrow.model.topic.Topics;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.load.LoadPlan;

/**
 * Runs sweeps through a suite. To find the knee, a sweep continues after its last point with twice the load each time, until a point no
 * longer holds.
 */
public final class Evaluation {
    private static final String DOMAIN = "evaluation";
    private static final Duration WARM_UP = Duration.ofSeconds(20);
    /** Maximum duration of points beyond a sweep: they only determine whether the load holds. */
    private static final long MAX_FURTHER_SECONDS = 20;
    /** Duration of start, warm-up, and the pauses around each point. */
    private static final long SECONDS_A_SUITE = 45;

    private static final long SECONDS_A_POINT = 6;

    private final Plan plan;
    private final EvaluationResults results;
    private final PrintWriter out;

    /**
     * The measurements of an evaluation.
     *
     * @param knee whether to find the knee
     * @param oneSuite whether all sweeps share a suite
     * @param target null for suites in this JVM, with stand-ins for context broker and IoT Agent
     */
    public record Plan(List<Sweep> sweeps, EvaluationResults.Run run, boolean knee, boolean oneSuite, Target target) {}

    public Evaluation(Plan plan, EvaluationResults results, PrintWriter out) {
        this.plan = plan;
        this.results = results;
        this.out = out;
    }

    /** The duration of a point, given that of the sweeps' points. */
    static long seconds(Point point, long seconds) {
        return point.sweep().points().contains(point) ? seconds : Math.min(seconds, MAX_FURTHER_SECONDS);
    }

    /** Measures the missing points. */
    public void run() throws Exception {
        List<Sweep> missing =
                plan.sweeps.stream().filter(sweep -> next(sweep) != null).toList();
        List<List<Sweep>> suites = new ArrayList<>();
        if (plan.oneSuite || plan.target != null) {
            suites.add(missing);
        } else {
            missing.forEach(sweep -> suites.add(List.of(sweep)));
        }
        for (int i = 0; i < suites.size() && !missing.isEmpty(); i++) {
            out.printf(
                    "Some %d min to go%s%n",
                    minutes(suites.subList(i, suites.size())), plan.knee ? ", and the way to the knee" : "");
            out.flush();
            runInSuite(suites.get(i));
        }
    }

    private void runInSuite(List<Sweep> sweeps) throws Exception {
        if (plan.target != null) {
            run(sweeps, plan.target);
            return;
        }
        try (RunDirectory directory = RunDirectory.open(null);
                Suite suite = Suite.start(SuiteSettings.onFreePorts("10s"), directory, new Progress(out))) {
            run(sweeps, Target.of(suite));
        }
    }

    private long minutes(List<List<Sweep>> suites) {
        long seconds = suites.size() * SECONDS_A_SUITE;
        for (List<Sweep> sweeps : suites) {
            for (Sweep sweep : sweeps) {
                seconds += sweep.points().stream()
                                .filter(point -> !isMeasured(point))
                                .count()
                        * (plan.run.seconds() + SECONDS_A_POINT);
            }
        }
        return (seconds + 59) / 60;
    }

    private boolean isMeasured(Point point) {
        return results.of(plan.run, point) != null;
    }

    /** The first point that has not been measured; null if there is none. */
    private Point next(Sweep sweep) {
        for (Point point : sweep.points()) {
            if (!isMeasured(point)) {
                return point;
            }
        }
        Point last = sweep.points().get(sweep.points().size() - 1);
        while (plan.knee && last != null) {
            PointResult result = results.of(plan.run, last);
            if (result == null) {
                return last;
            }
            last = result.holds() ? sweep.further(last) : null;
        }
        return null;
    }

    private void run(List<Sweep> sweeps, Target target) throws Exception {
        LoadMeasurement measurement = new LoadMeasurement(target.devices(), target.kafka(), this::progress);
        measurement.run(new LoadPlan(25, Duration.ofMillis(200), 1_000, WARM_UP, DOMAIN, "warmup"));
        for (Sweep sweep : sweeps) {
            progress(sweep.title());
            try (SubscriptionCopies copies = new SubscriptionCopies(target.devices())) {
                for (Point point = next(sweep); point != null; point = next(sweep)) {
                    copies.ensure(point.copies());
                    PointResult result = measure(target, measurement, point);
                    results.add(result);
                    print(result);
                }
            }
        }
    }

    private PointResult measure(Target target, LoadMeasurement measurement, Point point) throws Exception {
        LoadPlan load = point.plan(Duration.ofSeconds(seconds(point, plan.run.seconds())), DOMAIN);
        LongAdder notified = new LongAdder();
        ThreadTimes before = ThreadTimes.of(ProcessHandle.current().pid());
        long from = System.nanoTime();
        LoadReport report;
        // Only if there are copies: another reader of large messages would affect the measurement.
        if (point.sweep() == Sweep.SUBSCRIPTIONS) {
            try (TopicReader raw = TopicReader.fromEnd(target.kafka(), TopicReader.COMMITTED, Topics.RAW)) {
                raw.follow(records -> records.forEach(record -> count(record, load, notified)));
                report = measurement.run(load);
            }
        } else {
            report = measurement.run(load);
            notified.add(report.delivered());
        }
        double nanos = System.nanoTime() - from;
        Map<String, Double> cores = new HashMap<>();
        if (target.isOurs()) {
            ThreadTimes.of(ProcessHandle.current().pid())
                    .since(before)
                    .byRole()
                    .forEach((role, time) -> cores.put(role, time / nanos));
        }
        return PointResult.of(
                plan.run,
                point,
                report,
                notified.sum(),
                cores,
                target.isOurs()
                        ? 1024 * ProcessStatus.of(ProcessHandle.current().pid(), "VmRSS")
                        : 0);
    }

    /** Excludes notifications about provisioning, which have no payload. */
    private static void count(ConsumerRecord<byte[], byte[]> record, LoadPlan plan, LongAdder notified) {
        String entity = new String(record.key(), StandardCharsets.UTF_8);
        String value = new String(record.value(), StandardCharsets.UTF_8);
        if (entity.contains(":" + plan.mission() + "-") && value.contains("\"Payload\"")) {
            notified.increment();
        }
    }

    private void print(PointResult result) {
        progress(String.format(
                Locale.ROOT,
                "%-18s %6.0f/s  sent %6d  delivered %.4f  duplicated %d  reordered %d  ms p50 %d p99 %d max %d  %s%s",
                result.point().title(),
                result.point().rate(),
                result.sent(),
                result.deliveredRatio(),
                result.duplicated(),
                result.reordered(),
                result.endToEnd().p50(),
                result.endToEnd().p99(),
                result.endToEnd().max(),
                result.busiest(),
                result.holds() ? "" : "  beyond the knee: " + result.limit()));
    }

    private void progress(String line) {
        out.println("  " + line);
        out.flush();
    }

    /**
     * The suite under evaluation.
     *
     * @param devices where loads go in
     * @param kafka settings of a client of the Kafka at which they come out
     * @param isOurs whether it runs in this JVM, so that its processor time and memory are known
     */
    public record Target(FleetSettings devices, Properties kafka, boolean isOurs) {
        static Target of(Suite suite) {
            return new Target(suite.devices(), suite.kafka().clientProperties(), true);
        }
    }
}
