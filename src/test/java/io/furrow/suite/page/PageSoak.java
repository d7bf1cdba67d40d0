package io.furrow.suite.page;

import java.lang.management.ManagementFactory;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.TreeMap;
import java.util.concurrent.atomic.AtomicBoolean;

import com.sun.management.OperatingSystemMXBean;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Long checks of the page, and its screenshots: {@code ./furrow soak page}. */
public final class PageSoak {
    private static final long HALF_A_SECOND = 500;
    private static final double SHARE_OF_A_CORE = 0.02;
    private static final int HIDDEN_TURNS = 10;
    /** Time after which a hidden page has closed its streams and the server its consumers: ten seconds and a margin. */
    private static final int CLOSE_MILLIS = 15_000;

    private static final double MAX_RATIO = 2;
    private static final long FIRST_VIEW_MILLIS = 3_000;
    private static final double MAX_SHIFT = 0.02;
    private static final int WARM_UP_SECONDS = 8;
    private static final int BARE_SECONDS = 20;

    private PageSoak() {}

    /**
     * {@code pictures FOLDER}, {@code delay EVENTS}, {@code heap DEVICES MINUTES}, {@code hidden SECONDS}, or without a
     * suite {@code frames DEVICES TURNS SECONDS} and {@code crowd DEVICES SECONDS}.
     */
    public static void main(String[] arguments) throws Exception {
        boolean passed;
        if (arguments[0].equals("frames")) {
            System.exit(frames(number(arguments[1]), number(arguments[2]), number(arguments[3])) ? 0 : 1);
        }
        if (arguments[0].equals("crowd")) {
            System.exit(crowd(number(arguments[1]), number(arguments[2])) ? 0 : 1);
        }
        try (PageSuite suite = PageSuite.start()) {
            passed = switch (arguments[0]) {
                case "pictures" -> Pictures.take(suite, Path.of(arguments[1]));
                case "delay" -> delay(suite, Integer.parseInt(arguments[1]));
                case "heap" -> heap(suite, Integer.parseInt(arguments[1]), Integer.parseInt(arguments[2]));
                case "hidden" -> hidden(suite, Integer.parseInt(arguments[1]));
                default -> throw new IllegalArgumentException(arguments[0]);
            };
        }
        System.exit(passed ? 0 : 1);
    }

    private static int number(String argument) {
        return Integer.parseInt(argument);
    }

    /** Measures the bare page, the map, and the map with cards in turns; each is first equally often. */
    private static boolean frames(int devices, int rounds, int seconds) {
        List<String> pages = new ArrayList<>(List.of(FrameTimes.BARE, FrameTimes.MAP, FrameTimes.CARDS));
        Map<String, List<Double>> millis = new TreeMap<>();
        try (FrameTimes times = new FrameTimes(devices)) {
            for (int round = 0; round < rounds; round++) {
                for (String page : pages) {
                    double time = times.measure(page, seconds);
                    millis.computeIfAbsent(page, key -> new ArrayList<>()).add(time);
                    print("a frame of %s: %.1f ms", page, time);
                }
                Collections.rotate(pages, 1);
            }
        }
        double bare = median(millis.get(FrameTimes.BARE));
        double map = median(millis.get(FrameTimes.MAP));
        double cards = median(millis.get(FrameTimes.CARDS));
        print(
                "main thread for a frame of %d devices, median of %d turns: bare page %.1f ms, map %.1f ms, %.2f times, with cards %.1f ms, %.2f times",
                devices, rounds, bare, map, map / bare, cards, cards / bare);
        return Math.max(map, cards) <= MAX_RATIO * bare;
    }

    /** Watches a crowded farm, and compares the time of its frames with those of a bare page with as many devices. */
    private static boolean crowd(int devices, int seconds) throws Exception {
        long opening;
        Crowd.Watched watched;
        try (Crowd crowd = new Crowd(devices)) {
            opening = crowd.open();
            watched = crowd.watch(WARM_UP_SECONDS, seconds);
        }
        double bare;
        try (FrameTimes times = new FrameTimes(devices)) {
            bare = times.measure(FrameTimes.BARE, Math.min(seconds, BARE_SECONDS));
        }
        double ratio = watched.millisPerFrame() / bare;
        print(
                "%d devices, 40 alarms: first view after %d ms; in %d s Stop moved %d times, largest layout shift %.4f, all together %.4f",
                devices, opening, seconds, watched.moves(), watched.largestShift(), watched.allShifts());
        print(
                "main thread for a frame of the map %.1f ms, %.2f times the %.1f ms of a bare page",
                watched.millisPerFrame(), ratio, bare);
        return opening <= FIRST_VIEW_MILLIS
                && watched.moves() == 0
                && watched.largestShift() <= MAX_SHIFT
                && ratio <= MAX_RATIO;
    }

    private static double median(List<Double> values) {
        List<Double> sorted = values.stream().sorted().toList();
        return (sorted.get((sorted.size() - 1) / 2) + sorted.get(sorted.size() / 2)) / 2;
    }

    private static boolean delay(PageSuite suite, int events) throws Exception {
        Marks.Delays delays = Marks.measure(suite, events, 700);
        boolean passed = true;
        for (boolean canvas : new boolean[] {true, false}) {
            List<Long> millis = canvas ? delays.canvas() : delays.card();
            long high = Marks.Delays.percentile(millis, 0.95);
            print(
                    "from Kafka to the %s: %d of %d events, median %d ms, p95 %d ms, max %d ms",
                    canvas ? "pixel of the map" : "number on the card",
                    millis.size(),
                    events,
                    Marks.Delays.percentile(millis, 0.5),
                    high,
                    millis.get(millis.size() - 1));
            passed &= high <= HALF_A_SECOND && (!canvas || millis.size() > events * 9 / 10);
        }
        return passed;
    }

    /** Starts a thread that reports moving devices, each once a second, on {@code data.raw}. */
    private static Thread fleet(PageSuite suite, int devices, AtomicBoolean stopped) {
        Properties properties = suite.running().suite().kafka().clientProperties();
        Thread thread = new Thread(
                () -> {
                    try (KafkaProducer<byte[], byte[]> producer =
                            new KafkaProducer<>(properties, new ByteArraySerializer(), new ByteArraySerializer())) {
                        for (long second = 0; !stopped.get(); second++) {
                            long due = System.currentTimeMillis() + 1000;
                            for (int number = 0; number < devices && !stopped.get(); number++) {
                                producer.send(report(number, second));
                                if (number % 50 == 49) {
                                    Thread.sleep(Math.max(
                                            0, (due - System.currentTimeMillis()) * 50L / (devices - number + 49)));
                                }
                            }
                            Thread.sleep(Math.max(0, due - System.currentTimeMillis()));
                        }
                    } catch (InterruptedException e) {
                        Thread.currentThread().interrupt();
                    }
                },
                "fleet");
        thread.setDaemon(true);
        thread.start();
        return thread;
    }

    private static ProducerRecord<byte[], byte[]> report(int number, long second) {
        String id = "urn:ngsi-ld:Tractor:" + number;
        double angle = (second + number) / 20.0;
        String entity = """
                {"id": "%s", "type": "Tractor", "Time": {"type": "Integer", "value": %d}, "speed": {"type": "Float", "value": %.2f},
                 "heading": {"type": "Float", "value": %.1f}, "battery": {"type": "Float", "value": 0.8},
                 "Latitude": {"type": "Float", "value": %.7f}, "Longitude": {"type": "Float", "value": %.7f}}""".formatted(
                        id,
                        System.currentTimeMillis(),
                        1 + Math.sin(angle),
                        Math.toDegrees(angle) % 360,
                        40.31 + number / 40 * 0.0002 + 0.00005 * Math.sin(angle),
                        -3.49 + number % 40 * 0.0003 + 0.00005 * Math.cos(angle));
        return new ProducerRecord<>("data.raw", id.getBytes(UTF_8), entity.getBytes(UTF_8));
    }

    private static boolean heap(PageSuite suite, int devices, int minutes) throws Exception {
        AtomicBoolean stopped = new AtomicBoolean();
        Thread fleet = fleet(suite, devices, stopped);
        FarmPage farm = suite.open("");
        farm.untilStore("store.entities.size >= " + devices);
        List<Double> used = new ArrayList<>();
        for (int minute = 1; minute <= minutes; minute++) {
            farm.page().waitForTimeout(60_000);
            used.add(farm.heap());
            print(
                    "minute %d: heap of the page after collection %.1f MiB, %s devices",
                    minute, used.get(minute - 1), farm.store("store.entities.size"));
        }
        stopped.set(true);
        fleet.join();
        double growth = used.get(minutes - 1) / used.get(0);
        print("last minute by first: %.3f", growth);
        return growth <= FarmPage.HEAP_GROWTH;
    }

    /**
     * Compares the processor time of the whole suite with and without a hidden page, in turns that alternate which is
     * first, because the suite's other load varies.
     */
    private static boolean hidden(PageSuite suite, int seconds) throws Exception {
        FarmPage farm = suite.open("");
        farm.untilStore("store.primed");
        List<Double> differences = new ArrayList<>();
        for (int round = 0; round < HIDDEN_TURNS; round++) {
            double without = round % 2 == 0 ? shareWithout(farm, seconds) : 0;
            farm.open("");
            farm.untilStore("store.primed");
            farm.hide();
            farm.page().waitForTimeout(CLOSE_MILLIS);
            double with = share(farm, seconds);
            without = round % 2 == 0 ? without : shareWithout(farm, seconds);
            differences.add(with - without);
            print("suite with a hidden page %.1f %%, without %.1f %% of a core", 100 * with, 100 * without);
        }
        double median = median(differences);
        print("a hidden page costs the suite %.1f %% of a core (median of %d turns)", 100 * median, differences.size());
        return median <= SHARE_OF_A_CORE;
    }

    private static double shareWithout(FarmPage farm, int seconds) {
        farm.page().navigate("about:blank");
        farm.page().waitForTimeout(CLOSE_MILLIS);
        return share(farm, seconds);
    }

    private static double share(FarmPage page, int seconds) {
        OperatingSystemMXBean machine = (OperatingSystemMXBean) ManagementFactory.getOperatingSystemMXBean();
        long before = machine.getProcessCpuTime();
        long start = System.nanoTime();
        page.page().waitForTimeout(Duration.ofSeconds(seconds).toMillis());
        return (machine.getProcessCpuTime() - before) / (double) (System.nanoTime() - start);
    }

    static void print(String words, Object... values) {
        System.out.println(words.formatted(values));
    }
}
