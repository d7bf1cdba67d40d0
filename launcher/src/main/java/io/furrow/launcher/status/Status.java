package io.furrow.launcher.status;

import java.io.PrintWriter;
import java.net.URI;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Deque;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.OptionalLong;
import java.util.Properties;
import java.util.TreeMap;
import java.util.concurrent.ExecutionException;
import java.util.function.Supplier;
import java.util.stream.Collectors;

import org.apache.kafka.clients.admin.Admin;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.result.CollisionResult;
import io.furrow.model.result.FieldResult;

/**
 * The live status: records per second and total of each topic, the newest average of each field, collisions as they happen,
 * each job's lag. On a terminal it is drawn in place, elsewhere results come as lines and the totals every ten seconds.
 */
public final class Status implements AutoCloseable {
    private static final int COLLISIONS_SHOWN = 6;
    private static final int SECONDS_BETWEEN_BLOCKS = 10;

    /**
     * What is shown.
     *
     * @param client of Kafka
     * @param jobs ids by name
     * @param notices a sentence for each thing that waits for somebody
     */
    public record Shown(
            Admin admin,
            Properties client,
            URI flink,
            Map<String, String> jobs,
            Supplier<Collection<String>> notices) {}

    private final PrintWriter out;
    private final boolean inPlace;
    private final TopicTotals totals;
    private final Rates rates = new Rates();
    private final JobLag lag;
    private final Results results;
    private final Supplier<Collection<String>> notices;
    private final Map<String, String> averages = new TreeMap<>();
    private final Deque<String> collisions = new ArrayDeque<>();
    private int drawn;
    private long ticks;

    /**
     * @param inPlace whether the output is a terminal that can be drawn over
     * @param suite what is shown
     */
    public Status(PrintWriter out, boolean inPlace, Shown suite) {
        this.out = out;
        this.inPlace = inPlace;
        this.totals = new TopicTotals(suite.admin());
        this.lag = new JobLag(suite.flink(), suite.jobs());
        this.results = new Results(suite.client(), this::tell);
        this.notices = suite.notices();
    }

    public void start() {
        results.start();
    }

    /** Reads and shows once; to be called every second. A Kafka that does not answer is shown, not fatal. */
    public void tick() throws InterruptedException {
        boolean due = inPlace || ticks++ % SECONDS_BETWEEN_BLOCKS == 0;
        if (!due) {
            return;
        }
        try {
            TreeMap<String, Long> now = totals.read();
            show(lines(now, rates.next(now, System.nanoTime()), lag.read()));
        } catch (ExecutionException e) {
            show(List.of("Kafka does not tell its totals: " + e.getCause().getMessage()));
        }
    }

    @Override
    public void close() {
        results.close();
    }

    private synchronized void tell(Entity entity) {
        boolean average = entity.type().equals(FieldResult.TEMPERATURE_TYPE);
        String line = average ? ResultLines.average(entity) : ResultLines.collision(entity);
        if (average) {
            averages.put(entity.id(), line);
        } else if (!CollisionResult.ONGOING.equals(
                entity.text(CollisionResult.PHASE).orElse(""))) {
            collisions.addFirst(line);
            while (collisions.size() > COLLISIONS_SHOWN) {
                collisions.removeLast();
            }
        } else {
            return;
        }
        if (!inPlace) {
            out.println((average ? "average   " : "collision ") + line);
            out.flush();
        }
    }

    private synchronized List<String> lines(
            Map<String, Long> now, Map<String, Double> perSecond, Map<String, OptionalLong> lags) {
        List<String> lines = new ArrayList<>();
        lines.add(String.format("%-52s %10s %12s", "topic", "per second", "total"));
        now.forEach((topic, total) -> lines.add(
                String.format(Locale.ROOT, "%-52s %10.1f %12d", topic, perSecond.getOrDefault(topic, 0.0), total)));
        String known = lags.entrySet().stream()
                .filter(job -> job.getValue().isPresent()) // one that has read nothing yet has none
                .map(job -> job.getKey() + " " + job.getValue().getAsLong() + " records")
                .collect(Collectors.joining("   "));
        lines.add("lag  " + (known.isEmpty() ? "not known yet" : known));
        lines.addAll(notices.get());
        if (inPlace) {
            lines.add("");
            lines.add("averages");
            averages.values().forEach(line -> lines.add("  " + line));
            lines.add("collisions");
            collisions.forEach(line -> lines.add("  " + line));
        }
        return lines;
    }

    private synchronized void show(List<String> lines) {
        if (inPlace && drawn > 0) {
            out.printf("\033[%dA\033[J", drawn); // up over what was drawn, and clear from there
        }
        lines.forEach(out::println);
        out.flush();
        drawn = lines.size();
    }
}
