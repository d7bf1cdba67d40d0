package io.furrow.mission.image;

import java.util.HashMap;
import java.util.Map;
import java.util.Random;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.event.FiwareScope;

import static org.assertj.core.api.Assertions.assertThat;

class ImageNameTest {
    private static final long TIME = 1_700_000_000_123L;

    @Test
    void namesAFileByDomainMissionEntityAndTimeInUtc() {
        ImageName name = ImageName.of(FiwareScope.DEFAULT, "north", "weeding", "Camera-1", 1_700_000_000_123L);

        assertThat(name.path("png")).isEqualTo("north/weeding/Camera-1/Camera-1_20231114221320123.png");
        assertThat(name.path("jpg", "abc")).isEqualTo("north/weeding/Camera-1/Camera-1_20231114221320123-abc.jpg");
    }

    @ParameterizedTest
    @CsvSource(textBlock = """
                    farm, /,      ~tenant-farm/d/m/c
                    '',   /north, ~path-~2Fnorth/d/m/c
                    farm, /north, ~tenant-farm/~path-~2Fnorth/d/m/c
                    '',   /,      d/m/c
                    """)
    void keepsTenantsAndServicePathsApart(String tenant, String path, String folder) {
        assertThat(ImageName.of(new FiwareScope(tenant, path), "d", "m", "c", TIME)
                        .folder())
                .isEqualTo(folder);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', ignoreLeadingAndTrailingWhitespace = true, textBlock = """
                    Camera-1            | Camera-1
                    a.b_c               | a.b_c
                    urn:ngsi-ld:Camera:1| urn~3Angsi-ld~3ACamera~3A1
                    ''                  | ~none
                    ~none               | ~7Enone
                    .                   | ~2E
                    ..                  | ~2E.
                    .hidden             | ~2Ehidden
                    a/b                 | a~2Fb
                    ../../etc/passwd    | ~2E.~2F..~2Fetc~2Fpasswd
                    a~2Fb               | a~7E2Fb
                    a b                 | a~20b
                    ñ                   | ~C3~B1
                    """)
    void makesEveryPartSafeForEveryFileSystem(String name, String part) {
        assertThat(ImageName.part(name)).isEqualTo(part);
    }

    @Test
    void shortensAPartThatIsTooLongToItsHash() {
        String tooLong = "c".repeat(121);

        assertThat(ImageName.part("c".repeat(120))).isEqualTo("c".repeat(120));
        assertThat(ImageName.part(tooLong)).startsWith("~h").hasSize(66);
        assertThat(ImageName.part(tooLong)).isNotEqualTo(ImageName.part(tooLong + "c"));
    }

    @Test
    void fitsIntoAFileNameHoweverLongTheEntityId() {
        ImageName name = ImageName.of(FiwareScope.DEFAULT, "d", "m", "c".repeat(120), TIME);

        assertThat(name.path("jpg", "f".repeat(64)).replaceAll(".*/", "")).hasSizeLessThanOrEqualTo(255);
    }

    @Test
    void givesNoTwoNamesTheSamePart() {
        Random random = new Random(3);
        String characters = "ab.~:/_-%7EhHnone2F ñ";
        Map<String, String> byPart = new HashMap<>();
        for (int i = 0; i < 100_000; i++) {
            StringBuilder name = new StringBuilder();
            for (int length = random.nextInt(6); length > 0; length--) {
                name.append(characters.charAt(random.nextInt(characters.length())));
            }
            String other = byPart.put(ImageName.part(name.toString()), name.toString());
            assertThat(other == null || other.contentEquals(name))
                    .as("%s and %s", other, name)
                    .isTrue();
        }
        assertThat(byPart).hasSizeGreaterThan(10_000);
    }
}
