package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Random;

import io.furrow.analytics.Seeds;
import io.furrow.analytics.field.FieldRecords;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;

/**
 * Several cases that run as one job, because a job takes longer to start than a case to run. They are at places and times so far apart
 * that none sees anything of another; what they share are the options.
 *
 * <p>A case: fields, devices and the readings that arrive from them: out of order, repeated, from defective devices, from borders, while
 * fields come, change, go and are removed. Corners are on whole and half degrees, and devices stand on half degrees, so
 * that many stand on borders and corners.
 *
 * @param changes of fields, in the order in which they come; those before the first reading are known at the start
 * @param bound out-of-orderness, ms; half of the cases keep it, the others have late readings
 */
record RandomCases(
        List<Change> changes, List<Arrival> readings, Setting setting, long bound, boolean inBounds, int parallelism) {
    /** Numbers of the job's options, in ms. */
    record Setting(long window, long slide, long lateness, double floor) {}

    /**
     * What is said of a field at one point of the run.
     *
     * @param before how many readings come first
     * @param shape null if the field ends
     * @param taken whether the version is removed
     */
    record Change(int before, String field, long validFrom, String domain, Shape shape, boolean taken) {
        /** What is known at the start stays so. */
        private Change behind(int readings) {
            return before == 0 ? this : new Change(before + readings, field, validFrom, domain, shape, taken);
        }
    }

    /** A reading as the oracle sees it, and as the job does. */
    record Arrival(String device, double latitude, double longitude, double value, long time, TopicRecord record) {}

    /** Where and when one of the cases is. */
    private record Place(int number) {
        private static final int DEGREES = 10;
        private static final long MILLIS = 240_000;

        double east() {
            return DEGREES * number;
        }

        long begin() {
            return BEGIN + MILLIS * number;
        }

        String named(String id) {
            return "c" + number + id;
        }
    }

    private record Device(String id, double latitude, double longitude, double bias) {}

    private static final long BEGIN = 1_700_000_000_000L;
    private static final int LENGTH = 120_000;
    static final int TOGETHER = 10;

    /** @param parallelism with late readings one: among several it depends on chance who sees the watermark first */
    static RandomCases of(long seed, int parallelism) {
        Random random = Seeds.random(seed);
        boolean inBounds = seed % 2 == 0;
        boolean live = seed % 4 != 0;
        long slide = (1 + random.nextInt(6)) * 5_000L;
        long window = slide * (1 + random.nextInt(3));
        long bound = random.nextInt(10_000);
        long lateness = inBounds ? 0 : random.nextInt(3) * 3_000L;
        Setting setting = new Setting(window, slide, lateness, random.nextBoolean() ? 0 : 0.5);
        List<Change> changes = new ArrayList<>();
        List<Arrival> readings = new ArrayList<>();
        for (int number = 0; number < TOGETHER; number++) {
            Place place = new Place(number);
            List<Arrival> arrivals = arrivals(random, place, inBounds ? bound : bound + 20_000);
            changes(random, place, arrivals.size(), live)
                    .forEach(change -> changes.add(change.behind(readings.size())));
            readings.addAll(arrivals);
        }
        changes.sort(Comparator.comparingInt(Change::before)); // keeps the order of those that come together
        return new RandomCases(changes, readings, setting, bound, inBounds, inBounds ? parallelism : 1);
    }

    private static List<Change> changes(Random random, Place place, int readings, boolean live) {
        List<Change> changes = new ArrayList<>();
        for (int i = 0; i < 1 + random.nextInt(4); i++) {
            String field = place.named("f" + i);
            changes.add(new Change(0, field, 0, random.nextBoolean() ? "" : "d", shape(random, place), false));
        }
        int more = random.nextInt(5);
        for (int i = 0; i < more; i++) {
            String field = place.named("f" + random.nextInt(5));
            long validFrom = place.begin() + random.nextInt(LENGTH);
            Shape shape = random.nextInt(3) == 0 ? null : shape(random, place);
            changes.add(new Change(when(random, readings, live), field, validFrom, "d" + i, shape, false));
        }
        if (live && random.nextBoolean()) {
            Change some = changes.get(random.nextInt(changes.size()));
            int then = some.before() + random.nextInt(readings - some.before());
            changes.add(new Change(Math.max(then, 1), some.field(), some.validFrom(), "", null, true));
        }
        changes.sort(Comparator.comparingInt(Change::before));
        return changes;
    }

    private static Shape shape(Random random, Place place) {
        return Shape.of(random).movedEast(place.east());
    }

    private static int when(Random random, int readings, boolean live) {
        return live ? random.nextInt(readings) : 0;
    }

    private static List<Arrival> arrivals(Random random, Place place, long disorder) {
        List<Device> devices = new ArrayList<>();
        for (int i = 0; i < 2 + random.nextInt(8); i++) {
            double bias = random.nextInt(4) == 0 ? 40 * random.nextGaussian() : 0.3 * random.nextGaussian();
            double latitude = 1 + random.nextInt(12) / 2.0;
            double longitude = place.east() + random.nextInt(12) / 2.0;
            devices.add(new Device(place.named("d" + i), latitude, longitude, bias));
        }
        List<Arrival> arrivals = new ArrayList<>();
        List<long[]> order = new ArrayList<>();
        for (int i = 0; i < 300; i++) {
            Device device = devices.get(random.nextInt(devices.size()));
            long time = place.begin() + random.nextInt(LENGTH);
            if (i % 3 != 0 && time % 60_000 > 30_000) { // thinner now and then, so that windows stay empty
                time -= 30_000;
            }
            double value = 18 + device.bias() + Math.round(10 * random.nextGaussian()) / 10.0;
            arrivals.add(new Arrival(
                    device.id(),
                    device.latitude(),
                    device.longitude(),
                    value,
                    time,
                    Farm.reading(device.id(), value, device.latitude(), device.longitude(), time)));
            for (int copy = 0; copy < (random.nextInt(5) == 0 ? 2 : 1); copy++) {
                order.add(new long[] {time + (disorder == 0 ? 0 : random.nextLong(disorder)), i});
            }
        }
        // Whoever is delayed by less than the bound comes after nobody who is newer by more than the bound.
        return order.stream()
                .sorted((a, b) -> Long.compare(a[0], b[0]))
                .map(delayed -> arrivals.get((int) delayed[1]))
                .toList();
    }

    List<TopicRecord> arrivals() {
        return readings.stream().map(Arrival::record).toList();
    }

    /** Of each reading how many changes the job must have taken that were not known at the start. */
    int[] changesBefore() {
        int[] before = new int[readings.size()];
        for (int i = 0; i < before.length; i++) {
            int reading = i;
            before[i] = (int) changes.stream()
                    .filter(change -> change.before() > 0 && change.before() <= reading)
                    .count();
        }
        return before;
    }

    int[] readingsBefore() {
        return changes.stream().mapToInt(Change::before).toArray();
    }

    List<TopicRecord> fieldRecords() {
        FieldRecords records = new FieldRecords();
        for (Change change : changes) {
            if (change.taken()) {
                records.takeAway(change.field(), change.validFrom());
            } else if (change.shape() == null) {
                records.end(change.field(), change.validFrom());
            } else {
                records.area(
                        change.field(),
                        change.validFrom(),
                        change.domain(),
                        change.shape().coordinates());
            }
        }
        return records.all();
    }

    TopicSnapshot fieldsAtStart() {
        int known =
                (int) changes.stream().filter(change -> change.before() == 0).count();
        return new FixedRecords(fieldRecords().subList(0, known));
    }

    TemperatureOptions options() {
        return Farm.options(
                Farm.FIELDS,
                "--parallelism=" + parallelism,
                "--window=" + setting.window() + "ms",
                "--slide=" + setting.slide() + "ms",
                "--out-of-orderness=" + bound + "ms",
                "--allowed-lateness=" + setting.lateness() + "ms",
                "--repeat-window=1h", // a repetition that comes after it would be one more late reading
                "--suspect-floor=" + setting.floor());
    }
}
