package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.time.Instant;
import java.util.Set;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

class KnownEntitiesTest {
    @TempDir
    private Path folder;

    private KnownEntities open() throws IOException {
        return KnownEntities.open(folder.resolve("known"), 3);
    }

    @Test
    void knowsAfterARestartWhatCameAndWasNotDeleted() throws IOException {
        try (KnownEntities known = open()) {
            known.add("|/|a");
            known.add("|/|b|c");
            known.add("|/|a");
            known.remove("|/|a");
        }

        try (KnownEntities known = open()) {
            assertThat(known.copy()).isEqualTo(Set.of("|/|b|c"));
        }
        assertThat(folder.resolve("known")).hasContent("+|/|b|c");
    }

    @Test
    void leavesOutALineThatWasNotFinished() throws IOException {
        try (KnownEntities known = open()) {
            known.add("|/|whole");
        }
        Files.writeString(folder.resolve("known"), "+|/|hal", StandardOpenOption.APPEND);

        try (KnownEntities known = open()) {
            assertThat(known.copy()).isEqualTo(Set.of("|/|whole"));
        }
    }

    @Test
    void keepsLineBreaksAndBackslashesOfAnId() throws IOException {
        Set<String> strange = Set.of("|/|one\n+|/|two", "|/|a\r\nb", "|/|\\n");
        try (KnownEntities known = KnownEntities.open(folder.resolve("known"), 10)) {
            for (String identity : strange) {
                known.add(identity);
            }
            known.add("|/|gone\n+x");
            known.remove("|/|gone\n+x");
        }

        try (KnownEntities known = KnownEntities.open(folder.resolve("known"), 10)) {
            assertThat(known.copy()).isEqualTo(strange);
        }
    }

    @Test
    void leavesOutLinesThatAreNoIdentity() throws IOException {
        Files.writeString(folder.resolve("known"), "+x\n+|/|a\n+\n-x\n");

        try (KnownEntities known = open()) {
            assertThat(known.copy()).isEqualTo(Set.of("|/|a"));
        }
    }

    @Test
    void beginsAnewWithAFileThatIsNotItsOwn() throws IOException {
        Files.write(folder.resolve("known"), new byte[] {(byte) 0xff, '\n', (byte) 0xfe, '\n'});

        try (KnownEntities known = open()) {
            assertThat(known.copy()).isEmpty();
        }
    }

    @Test
    void knowsNoneOfMoreThanItCanKnow() throws IOException {
        try (KnownEntities known = open()) {
            for (int i = 0; i < 4; i++) {
                known.add("|/|" + i);
            }
            assertThat(known.isOverfull()).isTrue();
            assertThat(known.copy()).isEmpty();
        }

        try (KnownEntities known = open()) {
            known.add("|/|0");
            assertThat(known.isOverfull()).isTrue();
            assertThat(known.size()).isZero();
        }
    }

    @Test
    void keepsAWatermarkThatNeverMovesBack() throws IOException {
        Instant time = Instant.parse("2026-11-21T12:00:00Z");
        Path file = folder.resolve("watermark");
        assertThat(Watermark.open(file).time()).isEmpty();

        Watermark watermark = Watermark.open(file);
        watermark.advanceTo(time);
        watermark.advanceTo(time.minusSeconds(1));

        assertThat(Watermark.open(file).time()).contains(time);
        Files.write(file, "no time".getBytes(StandardCharsets.UTF_8));
        assertThat(Watermark.open(file).time()).isEmpty();
    }

    @Test
    void takesAnIdentityApart() {
        var scope = new io.furrow.model.event.FiwareScope("agri", "/a%|b");
        String identity = scope.identity("urn:x|y");

        assertThat(Identities.scope(identity)).isEqualTo(scope);
        assertThat(Identities.id(identity)).isEqualTo("urn:x|y");
    }
}
