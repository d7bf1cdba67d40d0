package io.furrow.model.text;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class LogTextTest {
    @Test
    void leavesATextWithoutLineBreaksAsItIs() {
        String text = "urn:ngsi-ld:Fühler:1 \\n";

        assertThat(LogText.oneLine(text)).isSameAs(text);
    }

    @ParameterizedTest
    @CsvSource({"10, 000a", "13, 000d", "0, 0000", "27, 001b", "127, 007f", "133, 0085", "8232, 2028", "8233, 2029"})
    void showsWhatBreaksALineByItsNumber(int sign, String number) {
        String forged = "a" + (char) sign + "2026-11-22 ERROR all is lost";

        assertThat(LogText.oneLine(forged)).isEqualTo("a\\u" + number + "2026-11-22 ERROR all is lost");
    }
}
