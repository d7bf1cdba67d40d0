package io.furrow.mission.archive;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.SequenceInputStream;
import java.util.Arrays;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.UnreadableException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class LineLimitTest {
    @Test
    void failsAtALineThatIsTooLongAndNotAtManyLines() throws Exception {
        byte[] longest = new byte[LineLimit.MAX_BYTES + 1];
        Arrays.fill(longest, (byte) 'x');
        longest[longest.length - 1] = '\n';
        try (InputStream lines = new LineLimit(
                new SequenceInputStream(new ByteArrayInputStream(longest), new ByteArrayInputStream(longest)))) {
            assertThat(lines.readAllBytes()).hasSize(2 * longest.length);
        }

        longest[longest.length - 1] = 'x';
        try (InputStream line = new LineLimit(new ByteArrayInputStream(longest))) {
            assertThatThrownBy(line::readAllBytes)
                    .isInstanceOf(IOException.class)
                    .hasMessage("a line has more than 16 MiB")
                    .hasCauseInstanceOf(UnreadableException.class);
        }
    }
}
