package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.stream.Collectors;

import io.furrow.flink.TopicRecord;

/**
 * Fields, devices and the readings that arrive from them: out of order, repeated, from defective devices, from borders.
 * Fields are rectangles on whole degrees and devices stand on half degrees, so that many stand on borders and corners.
 *
 * @param bound out-of-orderness, ms; half of the cases keep it, the others have late readings
 */
record RandomCase(
        List<Rectangle> fields,
        List<Arrival> readings,
        long window,
        long slide,
        long bound,
        long lateness,
        double floor,
        boolean inBounds) {
    /** West, south, east, north in degrees. */
    record Rectangle(String id, int west, int south, int east, int north) {}

    /** A reading as the oracle sees it, and as the job does. */
    record Arrival(String device, double latitude, double longitude, double value, long time, TopicRecord record) {}

    private record Device(String id, double latitude, double longitude, double bias) {}

    static RandomCase of(long seed) {
        Random random = new Random(seed);
        boolean inBounds = seed % 2 == 0;
        long slide = (1 + random.nextInt(6)) * 5_000L;
        long window = slide * (1 + random.nextInt(3));
        long bound = random.nextInt(10_000);
        long lateness = inBounds ? 0 : random.nextInt(3) * 3_000L;
        double floor = random.nextBoolean() ? 0 : 0.2;
        return new RandomCase(
                rectangles(random),
                arrivals(random, inBounds ? bound : bound + 20_000),
                window,
                slide,
                bound,
                lateness,
                floor,
                inBounds);
    }

    private static List<Rectangle> rectangles(Random random) {
        List<Rectangle> rectangles = new ArrayList<>();
        for (int i = 0; i < 1 + random.nextInt(4); i++) {
            int west = random.nextInt(4);
            int south = 1 + random.nextInt(4);
            rectangles.add(
                    new Rectangle("f" + i, west, south, west + 1 + random.nextInt(3), south + 1 + random.nextInt(3)));
        }
        return rectangles;
    }

    private static List<Arrival> arrivals(Random random, long disorder) {
        List<Device> devices = new ArrayList<>();
        for (int i = 0; i < 2 + random.nextInt(8); i++) {
            double bias = random.nextInt(4) == 0 ? 40 * random.nextGaussian() : 0.3 * random.nextGaussian();
            devices.add(new Device("d" + i, 1 + random.nextInt(12) / 2.0, random.nextInt(12) / 2.0, bias));
        }
        List<Arrival> arrivals = new ArrayList<>();
        List<long[]> order = new ArrayList<>();
        for (int i = 0; i < 300; i++) {
            Device device = devices.get(random.nextInt(devices.size()));
            long time = 1_700_000_000_000L + random.nextInt(120_000);
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

    /** With late readings one subtask: among several it depends on chance who sees the watermark first. */
    String[] arguments() {
        return new String[] {
            "--parallelism", inBounds ? "2" : "1",
            "--window", window + "ms",
            "--slide", slide + "ms",
            "--out-of-orderness", bound + "ms",
            "--allowed-lateness", lateness + "ms",
            "--mad-floor", Double.toString(floor)
        };
    }

    String geoJson() {
        return fields.stream()
                .map(field -> String.format(
                        java.util.Locale.ROOT,
                        """
                        {"type": "Feature", "id": "%1$s", "geometry": {"type": "Polygon", "coordinates":
                        [[[%2$d, %3$d], [%4$d, %3$d], [%4$d, %5$d], [%2$d, %5$d], [%2$d, %3$d]]]}}""",
                        field.id(),
                        field.west(),
                        field.south(),
                        field.east(),
                        field.north()))
                .collect(Collectors.joining(",", "{\"type\": \"FeatureCollection\", \"features\": [", "]}"));
    }
}
