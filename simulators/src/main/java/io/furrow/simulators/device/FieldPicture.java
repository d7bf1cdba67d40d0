package io.furrow.simulators.device;

import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.time.Instant;
import java.time.ZoneOffset;
import java.time.format.DateTimeFormatter;
import java.util.Locale;
import javax.imageio.ImageIO;
import javax.imageio.stream.MemoryCacheImageOutputStream;

import io.furrow.model.ngsi.Position;

/**
 * Draws what a camera sees: sky, a sun that crosses it once a minute, crop rows, and a caption. Set pixel by pixel: neither
 * fonts nor a display are needed, which a bare JDK may lack.
 */
final class FieldPicture {
    static final int WIDTH = 320;
    static final int HEIGHT = 200;

    private static final int HORIZON = 75;
    private static final int SKY = 0x9CC9E8;
    private static final int SUN = 0xF7C948;
    private static final int SOIL = 0x7A5A3A;
    private static final int CROP = 0x3E8E41;
    private static final int CAPTION = 0x1B1B1B;
    private static final int LETTERS = 0xFFFFFF;
    private static final int ROW_METERS = 24;
    private static final DateTimeFormatter SECOND =
            DateTimeFormatter.ofPattern("yyyy-MM-dd HH:mm:ss", Locale.ROOT).withZone(ZoneOffset.UTC);

    private FieldPicture() {}

    /** A PNG of {@value #WIDTH} × {@value #HEIGHT} pixels. */
    static byte[] png(String name, Instant time, Position place) {
        BufferedImage image = new BufferedImage(WIDTH, HEIGHT, BufferedImage.TYPE_INT_RGB);
        int sun = (int) (time.toEpochMilli() / 1000 % 60 * WIDTH / 60);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                image.setRGB(x, y, y < HORIZON ? sky(x, y, sun) : ground(x, y));
            }
        }
        for (int y = HEIGHT - 34; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                image.setRGB(x, y, CAPTION);
            }
        }
        PixelFont.write(image, name.toUpperCase(Locale.ROOT), 4, HEIGHT - 30, LETTERS);
        String where = String.format(Locale.ROOT, "%.5f %.5f", place.latitude(), place.longitude());
        PixelFont.write(image, SECOND.format(time), 4, HEIGHT - 15, LETTERS);
        PixelFont.write(image, where, WIDTH - PixelFont.width(where) - 4, HEIGHT - 30, LETTERS);
        return encode(image);
    }

    private static int sky(int x, int y, int sun) {
        return Math.hypot(x - sun, y - 20) < 9 ? SUN : SKY;
    }

    /** Rows meet at a point on the horizon. */
    private static int ground(int x, int y) {
        double depth = (y - HORIZON + 4) / 80d;
        double across = (x - WIDTH / 2d) / depth;
        return Math.floorMod((int) Math.floor(across / ROW_METERS), 2) == 0 ? SOIL : CROP;
    }

    private static byte[] encode(BufferedImage image) {
        ByteArrayOutputStream bytes = new ByteArrayOutputStream(4096);
        // The memory cache, because ImageIO otherwise makes a temporary file for each picture.
        try (MemoryCacheImageOutputStream out = new MemoryCacheImageOutputStream(bytes)) {
            if (!ImageIO.write(image, "png", out)) {
                throw new IllegalStateException("this JDK cannot write PNG: it needs the module java.desktop");
            }
        } catch (IOException e) {
            throw new UncheckedIOException("a picture could not be written to memory", e);
        }
        return bytes.toByteArray();
    }
}
