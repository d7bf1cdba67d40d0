package io.furrow.connect.source;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Instant;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.UnaryOperator;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.source.notification.NotificationTranslator;
import io.furrow.connect.source.notification.ReceivedNotification;
import io.furrow.files.Folders;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/**
 * Every request under {@code src/test/resources/recorded} (those in {@code orion} went over the wire, the others were written
 * by hand) and the records beside it in {@code <name>.records}, one JSON object a line. After a wanted change:
 * {@code ./mvnw -pl ngsi-connector -am test -Dtest=GoldenRecordsTest -Dsurefire.failIfNoSpecifiedTests=false
 * -Dgolden.renew=true}, and read the difference.
 */
class GoldenRecordsTest {
    private static final Path RECORDED = Path.of("src/test/resources/recorded");
    private static final Instant RECEIVED = Instant.parse("2026-11-21T02:00:00Z");

    static List<Path> requests() throws IOException {
        return Folders.walk(RECORDED).stream()
                .filter(file -> file.toString().endsWith(".http"))
                .toList();
    }

    @ParameterizedTest
    @MethodSource("requests")
    void aRequestBecomesExactlyTheseRecords(Path request) throws IOException {
        String records = translate(Files.readString(request)).stream()
                .map(GoldenRecordsTest::toJson)
                .map(line -> line + "\n")
                .collect(Collectors.joining());
        Path golden = Path.of(request.toString().replace(".http", ".records"));
        if (Boolean.getBoolean("golden.renew")) {
            Files.writeString(golden, records);
        }

        assertThat(records).isEqualTo(Files.readString(golden));
    }

    private static List<KafkaRecord> translate(String request) {
        String[] headAndBody = request.split("\r?\n\r?\n", 2);
        Map<String, String> headers = headAndBody[0]
                .lines()
                .skip(1)
                .map(line -> line.split(": ", 2))
                .collect(Collectors.toMap(
                        header -> header[0].toLowerCase(Locale.ROOT), header -> header[1], (a, b) -> a, TreeMap::new));
        UnaryOperator<String> header = name -> headers.get(name.toLowerCase(Locale.ROOT));
        byte[] body = headAndBody[1].strip().getBytes(UTF_8);
        NotificationTranslator translator = new NotificationTranslator(
                new NgsiSourceConfig(Map.of("journal.dir", "/tmp/journal")).translation(), new Ledger());
        return translator
                .translate(ReceivedNotification.of(body, true, header, RECEIVED, "127.0.0.1 /v2/notify"))
                .records();
    }

    private static String toJson(KafkaRecord record) {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        json.put("topic", record.topic()).put("key", record.key());
        json.put("timestamp", record.time().toEpochMilli());
        ObjectNode headers = json.putObject("headers");
        record.headers().forEach(headers::put);
        json.put("value", record.value() == null ? null : new String(record.value(), UTF_8));
        return json.toString();
    }
}
