package io.furrow.simulators.camera;

import java.awt.image.BufferedImage;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.time.Instant;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.SplittableRandom;
import java.util.stream.LongStream;
import java.util.stream.Stream;
import javax.imageio.ImageIO;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.model.ngsi.Position;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class FieldPictureTest {
    private static final Position PLACE = new Position(40.3, -3.48);
    private static final Instant TIME = Instant.parse("2026-06-01T12:00:00Z");
    private static final String SIGNS = " 0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ:-./_";
    private static final int ADVANCE = 8;
    private static final int SIGN = 6;

    @Test
    void isAPngOfItsSize() throws IOException {
        byte[] png = FieldPicture.png(view("camera-1", List.of()));

        assertThat(png).startsWith(0x89, 'P', 'N', 'G').hasSizeBetween(1_000, 40_000);
        BufferedImage image = ImageIO.read(new ByteArrayInputStream(png));
        assertThat(image.getWidth()).isEqualTo(FieldPicture.WIDTH);
        assertThat(image.getHeight()).isEqualTo(FieldPicture.HEIGHT);
    }

    static Stream<View> views() {
        return LongStream.range(0, 40).mapToObj(seed -> {
            SplittableRandom random = new SplittableRandom(seed);
            Position place = new Position(random.nextDouble(-89, 89), random.nextDouble(-179, 179));
            String name = "camera_" + random.nextInt(1000) + ":x.y-" + seed;
            Instant time = TIME.plusSeconds(random.nextInt(100_000_000));
            return new View(name, time, place, random.nextDouble(360), "field-" + seed, List.of());
        });
    }

    @ParameterizedTest
    @MethodSource("views")
    void letsOneReadWhichCameraTookItWhenAndWhere(View view) throws IOException {
        List<String> lines = read(FieldPicture.png(view));

        assertThat(lines.get(0)).isEqualTo(view.camera().toUpperCase(Locale.ROOT));
        String[] parts = lines.get(1).split(" ");
        assertThat(Instant.parse(parts[0] + "T" + parts[1] + "Z")).isEqualTo(view.time());
        assertThat(Double.parseDouble(parts[2])).isEqualTo(view.place().latitude(), within(0.00001));
        assertThat(Double.parseDouble(parts[3])).isEqualTo(view.place().longitude(), within(0.00001));
        assertThat(lines.get(2)).isEqualTo(view.where().toUpperCase(Locale.ROOT));
    }

    @Test
    void letsOneReadWhatIsInSightTheNearestFirst() throws IOException {
        List<View.Thing> about = List.of(
                new View.Thing("robot-1", north(40)),
                new View.Thing("robot-2", north(20)),
                new View.Thing("robot-3", north(-20)),
                new View.Thing("robot-4", north(70)));

        assertThat(read(FieldPicture.png(view("camera-1", about))).get(2))
                .isEqualTo("FIELD-1 / ROBOT-2 20M / ROBOT-1 40M");
        assertThat(FieldPicture.png(view("camera-1", about))).isEqualTo(FieldPicture.png(view("camera-1", about)));
    }

    /** Right of the middle when it is to the east of a camera that looks north; larger when it is nearer. */
    @Test
    void drawsWhatIsInSightWhereItIs() throws IOException {
        Position east = new Position(PLACE.latitude() + 20 / 111_194.9, PLACE.longitude() + 0.00008);
        int[] far = red(List.of(new View.Thing("robot-1", east)));
        int[] near = red(List.of(new View.Thing("robot-1", north(10))));

        assertThat(far).isNotEmpty();
        assertThat(Arrays.stream(far)).allMatch(x -> x > FieldPicture.WIDTH / 2);
        assertThat(near.length).isGreaterThan(2 * far.length);
        assertThat(red(List.of())).isEmpty();
        assertThat(red(List.of(new View.Thing("robot-1", north(-10))))).isEmpty();
    }

    /** The columns of all pixels in the colour of robots. */
    private static int[] red(List<View.Thing> about) throws IOException {
        BufferedImage image = image(FieldPicture.png(view("camera-1", about)));
        int[] columns = new int[FieldPicture.WIDTH * FieldPicture.HEIGHT];
        int count = 0;
        for (int x = 0; x < FieldPicture.WIDTH; x++) {
            for (int y = 0; y < FieldPicture.HEIGHT; y++) {
                if ((image.getRGB(x, y) & 0xFFFFFF) == 0xC0392B) {
                    columns[count++] = x;
                }
            }
        }
        return Arrays.copyOf(columns, count);
    }

    private static View view(String camera, List<View.Thing> about) {
        return new View(camera, TIME, PLACE, 0, "field-1", about);
    }

    private static Position north(double meters) {
        return new Position(PLACE.latitude() + meters / 111_194.9, PLACE.longitude());
    }

    private static List<String> read(byte[] png) throws IOException {
        BufferedImage image = image(png);
        return Stream.of(0, 1, 2)
                .map(line -> line(image, FieldPicture.CAPTION_TOP + 3 + line * FieldPicture.LINE))
                .toList();
    }

    private static BufferedImage image(byte[] png) throws IOException {
        return ImageIO.read(new ByteArrayInputStream(png));
    }

    /** Reads as a person does: by comparing with the signs it knows. */
    private static String line(BufferedImage image, int top) {
        StringBuilder text = new StringBuilder();
        for (int x = FieldPicture.LEFT; x + SIGN <= FieldPicture.WIDTH; x += ADVANCE) {
            for (int i = 0; i < SIGNS.length(); i++) {
                if (shows(image, x, top, SIGNS.substring(i, i + 1))) {
                    text.append(SIGNS.charAt(i));
                    break;
                }
            }
        }
        return text.toString().stripTrailing();
    }

    private static boolean shows(BufferedImage image, int left, int top, String sign) {
        BufferedImage known = new BufferedImage(ADVANCE, 10, BufferedImage.TYPE_INT_RGB);
        PixelFont.write(known, sign, 0, 0, 0xFFFFFF);
        for (int x = 0; x < SIGN; x++) {
            for (int y = 0; y < 10; y++) {
                boolean lit = (image.getRGB(left + x, top + y) & 0xFFFFFF) == 0xFFFFFF;
                if (lit != ((known.getRGB(x, y) & 0xFFFFFF) == 0xFFFFFF)) {
                    return false;
                }
            }
        }
        return true;
    }
}
