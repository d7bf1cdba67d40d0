package io.furrow.model.text;

import java.nio.ByteBuffer;
import java.nio.charset.CharacterCodingException;
import java.util.Random;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class Utf8Test {
    @Test
    void agreesWithThePlatformOnEverySequenceOfUpToThreeBytes() {
        byte[] bytes = new byte[3];
        for (int n = 0; n < 1 << 24; n += n < 1 << 20 ? 1 : 61) {
            bytes[0] = (byte) n;
            bytes[1] = (byte) (n >> 8);
            bytes[2] = (byte) (n >> 16);
            assertAgreement(bytes);
        }
    }

    @Test
    void agreesWithThePlatformOnRandomSequences() {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        byte[] likely = {
            'a',
            (byte) 0xc2,
            (byte) 0xe0,
            (byte) 0xed,
            (byte) 0xf0,
            (byte) 0xf4,
            (byte) 0x80,
            (byte) 0x8f,
            (byte) 0x90,
            (byte) 0x9f,
            (byte) 0xa0,
            (byte) 0xbf,
            (byte) 0xc0,
            (byte) 0xff
        };
        for (int n = 0; n < 500_000; n++) {
            byte[] bytes = new byte[1 + random.nextInt(7)];
            for (int i = 0; i < bytes.length; i++) {
                bytes[i] = likely[random.nextInt(likely.length)];
            }
            assertAgreement(bytes);
        }
    }

    private static void assertAgreement(byte[] bytes) {
        boolean wrong = Utf8.firstWrong(bytes) >= 0;
        if (wrong == isUtf8(bytes)) {
            assertThat(wrong).as(java.util.HexFormat.of().formatHex(bytes)).isNotEqualTo(isUtf8(bytes));
        }
    }

    private static boolean isUtf8(byte[] bytes) {
        try {
            UTF_8.newDecoder().decode(ByteBuffer.wrap(bytes));
            return true;
        } catch (CharacterCodingException e) {
            return false;
        }
    }
}
