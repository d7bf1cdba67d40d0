package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.time.Instant;
import java.util.Set;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class EntityIdSetTest {
    /** Of an identity of four signs. */
    private static final int BYTES = 104 + 2 * 4;

    @TempDir
    private Path folder;

    private EntityIdSet open() throws IOException {
        return EntityIdSet.open(folder.resolve("known"), 3 * BYTES);
    }

    @Test
    void knowsAfterARestartWhatCameAndWasNotDeleted() throws IOException {
        try (EntityIdSet known = open()) {
            known.add("|/|T|a");
            known.add("|/|T|b");
            known.add("|/|T|a");
            known.remove("|/|T|a");
        }

        try (EntityIdSet known = open()) {
            assertThat(known.copy()).isEqualTo(Set.of("|/|T|b"));
        }
        assertThat(folder.resolve("known")).hasContent("+\"|/|T|b\"");
    }

    @Test
    void leavesOutALineThatWasNotFinished() throws IOException {
        try (EntityIdSet known = open()) {
            known.add("|/|T|w");
        }
        Files.writeString(folder.resolve("known"), "+\"|/|T|hal", StandardOpenOption.APPEND);

        try (EntityIdSet known = open()) {
            assertThat(known.copy()).isEqualTo(Set.of("|/|T|w"));
        }
    }

    @Test
    void keepsLineBreaksAndBackslashesOfAnId() throws IOException {
        var strange = Set.of("|/|T|one\n+|/|T|two", "|/|T|a\r\nb", "|/|T|\\n", "|/|T|100%0A\r", "|/|T|\"\ud800%u");
        try (EntityIdSet known = EntityIdSet.open(folder.resolve("known"), 1 << 20)) {
            for (String identity : strange) {
                known.add(identity);
            }
            known.add("|/|T|gone\n+x");
            known.remove("|/|T|gone\n+x");
        }

        try (EntityIdSet known = EntityIdSet.open(folder.resolve("known"), 1 << 20)) {
            assertThat(known.copy()).isEqualTo(strange);
        }
    }

    @Test
    void leavesOutLinesThatAreNoIdentity() throws IOException {
        Files.writeString(folder.resolve("known"), "+x\n+|/|T|b\n+\n-\n\n+null\n+\"c\"\n+\"|/|T|a\"\n+\"|/|T|d\"+\n");

        try (EntityIdSet known = open()) {
            assertThat(known.copy()).isEqualTo(Set.of("|/|T|a"));
        }
    }

    @Test
    void beginsAnewWithAFileThatIsNotItsOwn() throws IOException {
        Files.write(folder.resolve("known"), new byte[] {(byte) 0xff, '\n', (byte) 0xfe, '\n'});

        try (EntityIdSet known = open()) {
            assertThat(known.copy()).isEmpty();
        }
    }

    @Test
    void knowsNoneOfMoreThanItCanKnow() throws IOException {
        try (EntityIdSet known = open()) {
            for (int i = 0; i < 4; i++) {
                known.add("|/|T|" + i);
            }
            assertThat(known.isOverfull()).isTrue();
            assertThat(known.copy()).isEmpty();
        }

        try (EntityIdSet known = open()) {
            known.add("|/|T|0");
            assertThat(known.isOverfull()).isTrue();
            assertThat(known.size()).isZero();
        }
        try (EntityIdSet known = EntityIdSet.open(folder.resolve("known"), 1 << 20)) {
            assertThat(known.isOverfull()).as("with a higher bound").isFalse();
            assertThat(known.isIncomplete()).isTrue();
            known.add("|/|T|0");
            assertThat(known.size()).isEqualTo(1);
        }
    }

    @Test
    void takesNoMoreOfTheDiskThanItsEntitiesNeedHoweverManyComeAndGo() throws IOException {
        try (EntityIdSet known = EntityIdSet.open(folder.resolve("known"), 1 << 20)) {
            known.add("|/|T|stays");
            for (int i = 0; i < 200_000; i++) {
                known.add("|/|T|urn:" + i);
                known.remove("|/|T|urn:" + i);
                if (i % 10_000 == 0) {
                    known.flush();
                }
            }
            known.flush();

            assertThat(Files.size(folder.resolve("known"))).isLessThan(2 << 20);
        }
        try (EntityIdSet known = EntityIdSet.open(folder.resolve("known"), 1 << 20)) {
            assertThat(known.copy()).containsExactly("|/|T|stays");
        }
    }

    @Test
    void isWrittenAnewOnceThereIsRoomOnTheDisk() throws IOException {
        Path file = folder.resolve("known");
        try (EntityIdSet known = EntityIdSet.open(file, 1 << 20)) {
            known.add("|/|T|stays");
            for (int i = 0; i < 200_000; i++) {
                known.add("|/|T|urn:" + i);
                known.remove("|/|T|urn:" + i);
            }
            Path inTheWay = Files.createDirectory(folder.resolve("known.tmp"));
            assertThatThrownBy(known::flush).isInstanceOf(IOException.class);
            Files.delete(inTheWay);

            known.flush();

            assertThat(Files.size(file)).isLessThan(1 << 20);
        }
    }

    @Test
    void isWrittenAnewWhileEntitiesComeAndGo() throws Exception {
        Path file = folder.resolve("known");
        try (EntityIdSet known = EntityIdSet.open(file, 1 << 26)) {
            Thread writer = new Thread(() -> {
                for (int i = 0; i < 100_000; i++) {
                    try {
                        known.add("|/|T|urn:" + i);
                        if (i % 10 > 0) {
                            known.remove("|/|T|urn:" + i);
                        }
                    } catch (IOException e) {
                        throw new java.io.UncheckedIOException(e);
                    }
                }
            });
            writer.start();
            while (writer.isAlive()) {
                known.flush();
            }
            writer.join();
        }

        try (EntityIdSet known = EntityIdSet.open(file, 1 << 26)) {
            assertThat(known.copy()).hasSize(10_000).allMatch(identity -> identity.endsWith("0"));
        }
    }

    @Test
    void keepsWhatHasToBeReadAgainUntilAllOfItWas() throws IOException {
        try (EntityIdSet known = open()) {
            known.markStale("|/|T|a");
        }
        try (EntityIdSet known = open()) {
            assertThat(known.stale()).containsExactly("|/|T|a");
            Set<String> read = known.stale();
            known.markStale("|/|T|b");
            known.settle(read);
        }
        try (EntityIdSet known = open()) {
            assertThat(known.stale()).containsExactlyInAnyOrder("|/|T|a", "|/|T|b");
            known.settle(known.stale());
        }
        try (EntityIdSet known = open()) {
            assertThat(known.stale()).isEmpty();
        }
    }

    @Test
    void marksABoundedNumberOfEntities() throws IOException {
        try (EntityIdSet known = open()) {
            for (int i = 0; i < EntityIdSet.MAX_STALE; i++) {
                assertThat(known.markStale("|/|T|" + i)).isTrue();
            }
            assertThat(known.markStale("|/|T|one more")).isFalse();
            assertThat(known.markStale("|/|T|0")).isTrue();
        }

        try (EntityIdSet known = open()) {
            assertThat(known.stale()).hasSize(EntityIdSet.MAX_STALE);
        }
    }

    @Test
    void keepsAWatermarkThatNeverMovesBack() throws IOException {
        Instant time = Instant.parse("2026-11-21T12:00:00Z");
        Path file = folder.resolve("watermark");
        assertThat(Watermark.open(file).time()).isEmpty();

        Watermark watermark = Watermark.open(file);
        watermark.advanceTo(time, "a");
        watermark.advanceTo(time.minusSeconds(1), "a");

        assertThat(Watermark.open(file).time()).contains(time);
        assertThat(Watermark.open(file).isOfOther("a")).isFalse();
        assertThat(Watermark.open(file).isOfOther("b")).isTrue();
        watermark.advanceTo(time.minusSeconds(1), "b");
        assertThat(Watermark.open(file).time()).contains(time.minusSeconds(1));
        Files.write(file, "no time".getBytes(UTF_8));
        assertThat(Watermark.open(file).time()).isEmpty();
    }

    @Test
    void takesAnIdentityApart() {
        var scope = new io.furrow.model.event.FiwareScope("agri", "/a%|b");
        String identity = scope.identity("T%|U", "urn:x|y");

        assertThat(EntityKeys.scope(identity)).isEqualTo(scope);
        assertThat(EntityKeys.type(identity)).isEqualTo("T%|U");
        assertThat(EntityKeys.id(identity)).isEqualTo("urn:x|y");
    }
}
