package io.furrow.provisioner.account;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.time.LocalDateTime;
import java.time.ZoneId;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.device.DeviceConnection.ForeignTopic;

import static org.assertj.core.api.Assertions.assertThat;

/** Uses lines of Mosquitto 2.0.11. */
class MosquittoLogTest {
    private static final String USER = "furrow.d.hoeing.d.1.0";
    private static final String CONNECTED =
            "1795705077: New client connected from 127.0.0.1:43754 as c3 (p2, c1, k60, u'" + USER + "').\n";
    private static final String DENIED =
            "1795705078: Denied PUBLISH from c3 (d0, q1, r0, m1, '/k/e/attrs', ... (1 bytes))\n";

    @TempDir
    Path directory;

    @Test
    void reportsConnectionsAndDeniedMessages() throws Exception {
        MosquittoLog log = log(CONNECTED + DENIED + DENIED);

        assertThat(log.reports().get(USER))
                .isEqualTo(new LoginReport(
                        1_795_705_077_000L, null, new ForeignTopic(2, 1_795_705_078_000L, "/k/e/attrs")));
    }

    @ParameterizedTest
    @ValueSource(strings = {"2026-11-26T14:58:11", "2026-11-26 14:58:11"})
    void readsOtherTimestamps(String time) throws Exception {
        long expected = LocalDateTime.of(2026, 11, 26, 14, 58, 11)
                .atZone(ZoneId.systemDefault())
                .toInstant()
                .toEpochMilli();

        assertThat(log(CONNECTED.replace("1795705077", time))
                        .reports()
                        .get(USER)
                        .loggedIn())
                .isEqualTo(expected);
    }

    /** With {@code log_timestamp false}. */
    @Test
    void usesTheTimeOfReadingWithoutATimestamp() throws Exception {
        assertThat(log(CONNECTED.replace("1795705077: ", ""))
                        .reports()
                        .get(USER)
                        .loggedIn())
                .isEqualTo(42L);
    }

    @Test
    void waitsForAMissingFileAndForTheEndOfALine() throws Exception {
        Path file = directory.resolve("mosquitto.log");
        MosquittoLog log = new MosquittoLog(file, () -> 42L);
        assertThat(log.reports()).isEmpty();

        append(file, CONNECTED.substring(0, 30));
        assertThat(log.reports()).isEmpty();
        append(file, CONNECTED.substring(30));

        assertThat(log.reports()).containsOnlyKeys(USER);
    }

    @Test
    void followsARenamedOrTruncatedFile() throws Exception {
        Path file = directory.resolve("mosquitto.log");
        MosquittoLog log = log(CONNECTED);
        assertThat(log.reports().get(USER).foreign()).isNull();

        append(file, DENIED);
        Files.move(file, directory.resolve("mosquitto.log.1"));
        append(file, DENIED);
        assertThat(log.reports().get(USER).foreign().count()).isEqualTo(2);

        Files.write(file, new byte[0]);
        assertThat(log.reports()).hasSize(1);
        append(file, DENIED.replace("/k/e/attrs", "/k/f"));
        assertThat(log.reports().get(USER).foreign()).isEqualTo(new ForeignTopic(3, 1_795_705_078_000L, "/k/f"));

        Files.delete(file);
        assertThat(log.reports()).hasSize(1);
    }

    /** A client controls its id and topics. */
    @Test
    void preventsClientsFromImpersonatingOthers() throws Exception {
        String spy = "furrow.d.hoeing.spy.1.0";
        String id = "c3 (d0, q1, r0, m1, '/k', ... (1 bytes))";
        MosquittoLog log = log(CONNECTED
                + "1795705079: New client connected from 127.0.0.1:1 as %s (p2, c1, k60, u'%s').\n".formatted(id, spy)
                + "1795705080: Denied PUBLISH from %s (d0, q1, r0, m1, '/k/e', ... (1 bytes))\n".formatted(id)
                + "1795705081: Denied PUBLISH from stranger (d0, q1, r0, m1, '/k/e', ... (1 bytes))\n"
                + "1795705082: spy 1 x: New client connected from 1 as z (p2, c1, k60, u'%s').\n".formatted(USER)
                + "1795705083: New client connected from 127.0.0.1:1 as z (p2, c1, k60, u'agent').\n");

        assertThat(log.reports()).containsOnlyKeys(USER, spy);
        assertThat(log.reports().get(USER)).isEqualTo(new LoginReport(1_795_705_077_000L, null, null));
        assertThat(log.reports().get(spy).foreign().topic()).isEqualTo("/k/e");
    }

    private MosquittoLog log(String lines) throws IOException {
        Path file = directory.resolve("mosquitto.log");
        Files.writeString(file, lines);
        return new MosquittoLog(file, () -> 42L);
    }

    private static void append(Path file, String lines) throws IOException {
        Files.writeString(file, lines, StandardOpenOption.CREATE, StandardOpenOption.APPEND);
    }
}
