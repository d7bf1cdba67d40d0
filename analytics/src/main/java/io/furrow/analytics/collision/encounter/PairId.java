package io.furrow.analytics.collision.encounter;

import java.nio.charset.StandardCharsets;
import java.util.HexFormat;

import io.furrow.model.text.Sha256;

/** The first 128 bits of a SHA-256 over two identities, in lower-case hexadecimal. */
public final class PairId {
    private static final int BYTES = 16;

    private PairId() {}

    public static String of(String first, String second) {
        String text = first.length() + ":" + first + second;
        return HexFormat.of().formatHex(Sha256.of(text.getBytes(StandardCharsets.UTF_8)), 0, BYTES);
    }
}
