package io.furrow.simulators.load;

import java.nio.charset.StandardCharsets;
import java.util.SplittableRandom;

/**
 * Builds the measures of a load, {@code {"time", "stat", "payload"}}. A payload is device, run and sequence number,
 * then random letters and digits, so no two are equal; the letters are drawn once, because drawing 100 kB per message
 * costs more than sending it.
 */
final class LoadMessages {
    private static final String LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";
    private static final int SHIFTS = 4096;
    private static final byte[] END = {'"', '}'};

    private final int payloadBytes;
    private final String run;
    private final byte[] letters;

    /** @param run distinguishes the payloads of one run from those of another */
    LoadMessages(int payloadBytes, long run) {
        this.payloadBytes = payloadBytes;
        this.run = Long.toString(run, Character.MAX_RADIX);
        this.letters = new byte[payloadBytes + SHIFTS];
        SplittableRandom random = new SplittableRandom(run);
        for (int i = 0; i < letters.length; i++) {
            letters[i] = (byte) LETTERS.charAt(random.nextInt(LETTERS.length()));
        }
    }

    /** @param timeMs when it is sent, epoch ms */
    byte[] message(int device, long sequence, long timeMs) {
        byte[] start = ("{\"time\":" + timeMs + ",\"stat\":true,\"payload\":\"").getBytes(StandardCharsets.US_ASCII);
        byte[] head = (device + "." + run + "." + sequence + ".").getBytes(StandardCharsets.US_ASCII);
        byte[] message = new byte[start.length + payloadBytes + END.length];
        int shift = (int) Math.floorMod(31L * device + sequence, (long) SHIFTS);
        System.arraycopy(start, 0, message, 0, start.length);
        System.arraycopy(head, 0, message, start.length, head.length);
        System.arraycopy(letters, shift, message, start.length + head.length, payloadBytes - head.length);
        System.arraycopy(END, 0, message, message.length - END.length, END.length);
        return message;
    }
}
