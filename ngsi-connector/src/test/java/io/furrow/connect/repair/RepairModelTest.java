package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.TreeMap;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.broker.BrokerException;
import io.furrow.connect.repair.ModelBroker.Stored;
import io.furrow.connect.repair.ModelBroker.Told;
import io.furrow.connect.repair.ModelSource.Bounds;
import io.furrow.connect.repair.ModelSource.Topic;

import static org.assertj.core.api.Assertions.assertThat;

/**
 * A context broker that loses, repeats and reorders notifications, is restarted (its queue is lost and its counters go back),
 * goes away, and forgets entities, all of them too, and the subscription, at random, also while it is asked; and a source that is
 * restarted and has no room at times. After quiet the newest state of each entity on the topic is that of the context broker.
 *
 * <p>{@code -Dfurrow.repair.runs=N} and {@code -Dfurrow.repair.seed=S} run others; run i has the seed S + i. {@code
 * -Dfurrow.repair.report=FILE} writes what was done.
 */
@Tag("full")
class RepairModelTest {
    private static final int RUNS = Integer.getInteger("furrow.repair.runs", 300);
    private static final long SEED = Long.getLong("furrow.repair.seed", new Random().nextInt(Integer.MAX_VALUE));
    /** Where to write what was done; null for nowhere. */
    private static final String REPORT = System.getProperty("furrow.repair.report");

    private static final int LARGE = 5000;

    @TempDir
    private Path directory;

    private Random random;
    private ModelBroker broker;
    private ModelSource source;
    private Topic topic;
    private Path folder;
    private Bounds bounds;
    private final List<Told> delivered = new ArrayList<>();
    /** How many were delivered when the volume was unmounted. */
    private int deliveredBefore;

    private boolean isQuiet;
    private final Map<String, Integer> done = new TreeMap<>();

    @Test
    void endsInTheStateOfTheContextBroker() throws Exception {
        for (long seed = SEED; seed < SEED + RUNS; seed++) {
            try {
                run(seed);
            } catch (Exception | AssertionError e) {
                throw new AssertionError("with -Dfurrow.repair.runs=1 -Dfurrow.repair.seed=" + seed, e);
            }
        }
        if (REPORT != null) {
            Files.writeString(
                    Path.of(REPORT),
                    "no difference in %d runs of repairs from seed %d: %s%n".formatted(RUNS, SEED, done));
        }
    }

    private void run(long seed) throws Exception {
        random = new Random(seed);
        boolean tellsDeletions = random.nextInt(4) > 0;
        broker = new ModelBroker(tellsDeletions, this::disturb);
        topic = new Topic();
        folder = Files.createDirectory(directory.resolve(Long.toString(seed)));
        bounds = new Bounds(
                2 + random.nextInt(6),
                random.nextBoolean() ? LARGE : 1 << 20,
                random.nextInt(3) == 0 ? 2000 : 1 << 20,
                Duration.ZERO);
        delivered.clear();
        isQuiet = false;
        source = new ModelSource(broker, broker::nanos, folder, bounds, topic);
        for (int steps = 20 + random.nextInt(100); steps > 0; steps--) {
            step();
        }
        isQuiet = true;
        if (!broker.isMounted()) {
            source.look();
            moveVolume();
        }
        while (!broker.queue.isEmpty()) {
            deliver();
        }
        if (!tellsDeletions) {
            restartSource();
        }
        for (int looks = GapDetector.MAX_UNBALANCED + 5; looks > 0; looks--) {
            broker.pass(1000);
            source.look();
        }
        for (int listings = 2;
                listings > 0;
                listings--) { // that most are gone has to be confirmed, and what the second lacks
            broker.pass(ListingSchedule.AGREEMENT.toMillis());
            source.look();
        }
        assertThat(source.unconfirmed()).isEmpty();
        source.look(); // what a listing found again
        source.close();
        compare();
    }

    private void compare() {
        Map<String, String> expected = new TreeMap<>();
        Map<String, String> actual = new TreeMap<>(topic.values());
        for (Stored entity : broker.entities.values()) {
            Instant dead = topic.unreadable().get(entity.key());
            if (dead != null
                    && dead.equals(Instant.ofEpochMilli(entity.modified()))
                    && entity.value().length() > LARGE / 2) {
                actual.remove(entity.key());
            } else {
                expected.put(entity.key(), entity.value());
            }
        }
        assertThat(actual).isEqualTo(expected);
    }

    private void step() throws Exception {
        int dice = random.nextInt(100);
        if (dice < 60) {
            happen(dice);
        } else if (dice < 90) {
            look();
        } else if (dice < 93) {
            count("source restarted");
            restartSource();
        } else {
            broker.pass(random.nextInt(random.nextInt(4) == 0 ? 100_000 : 5000));
        }
    }

    private void look() throws IOException, InterruptedException {
        broker.away(random.nextInt(12) == 0);
        try {
            source.look();
            count("most entities missing", !source.unconfirmed().isEmpty());
        } catch (BrokerException e) {
            count("look failed");
        }
        broker.away(false);
    }

    private void restartSource() throws IOException {
        source.close();
        source = new ModelSource(broker, broker::nanos, folder, bounds, topic);
    }

    /** While the context broker answers. */
    private void disturb() {
        if (!isQuiet && source != null) {
            for (int i = random.nextInt(12) - 8; i > 0; i--) {
                happen(random.nextInt(60));
            }
        }
    }

    private void happen(int dice) {
        if (dice < 24) {
            change();
        } else if (dice < 44) {
            deliver();
        } else if (dice < 47) {
            lose();
        } else if (dice < 51) {
            repeat();
        } else if (dice < 53) {
            count("counters flushed");
            broker.flush();
        } else if (dice < 54) {
            if (random.nextInt(4) == 0) {
                moveVolume();
            } else {
                restartBroker();
            }
        } else if (dice < 55 && random.nextInt(3) == 0) {
            count("subscription forgotten");
            broker.forgetSubscription();
        } else if (dice < 56 && random.nextInt(3) == 0) {
            count("subscription stopped");
            broker.stopSubscription();
        } else if (dice < 58) {
            turnAway();
        } else {
            broker.pass(random.nextInt(3));
        }
    }

    private void moveVolume() {
        if (broker.isMounted()) {
            count("unmounted");
            deliveredBefore = delivered.size();
            broker.unmount();
        } else if (broker.isSubscribed()) { // the source polled it meanwhile
            count("mounted");
            delivered
                    .subList(deliveredBefore, delivered.size())
                    .clear(); // its times may be later than those that count
            broker.mount();
        }
    }

    private void change() {
        broker.pass(random.nextInt(3) == 0 ? 0 : random.nextInt(4));
        String id = "e" + random.nextInt(8);
        String type = id.equals("e0") || id.equals("e1") ? "Timed" : "Probe";
        if (random.nextInt(8) == 0) {
            count("deleted");
            broker.delete(id + " " + type);
        } else {
            count("changed");
            String value = "v" + random.nextInt(3) + (random.nextInt(20) == 0 ? "x".repeat(LARGE) : "");
            broker.put(id, type, value);
        }
    }

    private Told takeOne() {
        count("reordered", broker.queue.size() > 1);
        return broker.queue.remove(random.nextInt(3) == 0 ? random.nextInt(broker.queue.size()) : 0);
    }

    private void deliver() {
        if (!broker.queue.isEmpty()) {
            Told told = takeOne();
            delivered.add(told);
            source.take(told);
            broker.succeeded();
        }
    }

    private void lose() {
        if (!broker.queue.isEmpty()) {
            count("lost");
            takeOne();
            if (random.nextBoolean()) {
                broker.failed();
            }
        }
    }

    private void repeat() {
        if (!delivered.isEmpty()) {
            count("repeated");
            source.take(delivered.get(random.nextInt(delivered.size())));
        }
    }

    private void turnAway() {
        if (!broker.queue.isEmpty()) {
            count("turned away");
            source.turnAway(takeOne());
            broker.failed();
        }
    }

    private void restartBroker() {
        count("broker restarted");
        broker.restart();
        if (random.nextInt(8) == 0) {
            count("all entities forgotten");
            broker.entities.clear();
        }
        if (random.nextInt(3) == 0 && !broker.entities.isEmpty()) {
            count("entity forgotten");
            List<String> keys = new ArrayList<>(broker.entities.keySet());
            broker.entities.remove(keys.get(random.nextInt(keys.size())));
        }
    }

    private void count(String what) {
        count(what, true);
    }

    private void count(String what, boolean really) {
        done.merge(what, really ? 1 : 0, Integer::sum);
    }
}
