package io.furrow.suite.page;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Properties;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * Measures the time from Kafka's client to the pixel: a device moves between two positions, one event after the other.
 * In each frame the page reads the two pixels of the map's canvas and the number on the device's card.
 */
final class Marks {
    private static final String ID = "urn:ngsi-ld:Thermometer:mark";
    private static final List<List<Double>> PLACES =
            List.of(List.of(-3.483058, 40.312998), List.of(-3.483058, 40.31307));
    /** Runs after each frame. */
    private static final String WATCH = """
            async ([id, places]) => {
              const { project } = await import('/map/projection.js');
              const map = document.querySelector('furrow-map');
              const canvases = [...map.querySelectorAll('canvas.map-canvas')];
              const lit = (place) => {
                const [x, y] = map.map.getPixelFromCoordinate(project(...place));
                return canvases.some((canvas) => {
                  const ratio = canvas.width / canvas.clientWidth;
                  return canvas.getContext('2d').getImageData(Math.round((x - 5) * ratio), Math.round(y * ratio), 1, 1).data[3] > 200;
                });
              };
              window.marks = { canvas: [], card: [] };
              let [last, shown] = ['', ''];
              const measure = () => {
                const now = Date.now();
                const at = places.findIndex(lit);
                if (at !== last) { last = at; window.marks.canvas.push([at, now]); }
                const text = document.querySelector(`li.card[data-id="${id}"] .card-facts`)?.textContent ?? '';
                if (text !== shown) { shown = text; window.marks.card.push([Number(/(\\d+) °C/.exec(text)?.[1]), now]); }
                requestAnimationFrame(() => setTimeout(measure));
              };
              measure();
            }""";

    private Marks() {}

    /** Delays in milliseconds, sorted; without events that never reached the page. */
    record Delays(List<Long> canvas, List<Long> card) {
        static long percentile(List<Long> sorted, double share) {
            return sorted.get((int) Math.min(sorted.size() - 1, Math.ceil(share * sorted.size()) - 1));
        }
    }

    static Delays measure(PageSuite suite, int events, long millisBetween) throws Exception {
        FarmPage farm = suite.open("", WindowStyle.DESKTOP);
        farm.untilStore("store.primed && store.entities.size >= 17");
        farm.page().getByPlaceholder("Find a device, field or alarm").fill("thermometer mark");
        Properties properties = suite.running().suite().kafka().clientProperties();
        List<Long> sent = new ArrayList<>();
        try (var producer = new KafkaProducer<>(properties, new ByteArraySerializer(), new ByteArraySerializer())) {
            produce(producer, 0);
            assertThat(farm.card(ID)).containsText("0 °C");
            farm.run(WATCH, List.of(ID, PLACES));
            for (int number = 1; number <= events; number++) {
                farm.page().waitForTimeout(millisBetween);
                sent.add(System.currentTimeMillis());
                produce(producer, number);
            }
            farm.page().waitForTimeout(3_000);
            producer.send(new ProducerRecord<>("data.raw", ID.getBytes(UTF_8), null))
                    .get();
        }
        Delays delays = new Delays(delays(farm, "canvas", sent), delays(farm, "card", sent));
        farm.close();
        return delays;
    }

    /** Pairs events with observed positions (canvas) or numbers (card). */
    private static List<Long> delays(FarmPage farm, String target, List<Long> sent) {
        List<Long> delays = new ArrayList<>();
        List<?> observed = (List<?>) farm.run("window.marks." + target);
        for (int number = 1; number <= sent.size(); number++) {
            long since = sent.get(number - 1);
            long before = number < sent.size() ? sent.get(number) : Long.MAX_VALUE;
            int expected = target.equals("canvas") ? number % 2 : number;
            for (Object each : observed) {
                List<?> mark = (List<?>) each;
                if (mark.get(0) instanceof Number what
                        && mark.get(1) instanceof Number when
                        && what.intValue() == expected
                        && when.longValue() >= since
                        && (target.equals("card") || when.longValue() < before)) {
                    delays.add(when.longValue() - since);
                    break;
                }
            }
        }
        Collections.sort(delays);
        return delays;
    }

    private static void produce(KafkaProducer<byte[], byte[]> producer, int number) throws Exception {
        List<Double> place = PLACES.get(number % 2);
        String entity = """
                {"id": "%s", "type": "Thermometer", "Time": {"type": "Integer", "value": %d}, "Temperature": {"type": "Float", "value": %d},
                 "Latitude": {"type": "Float", "value": %s}, "Longitude": {"type": "Float", "value": %s}}""".formatted(ID, System.currentTimeMillis(), number, place.get(1), place.get(0));
        producer.send(new ProducerRecord<>("data.raw", ID.getBytes(UTF_8), entity.getBytes(UTF_8)))
                .get();
    }
}
