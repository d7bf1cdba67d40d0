package io.furrow.cli.command;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.cli.control.StubControl;

import static org.assertj.core.api.Assertions.assertThat;

class CatalogCommandTest {
    @AutoClose
    private final StubControl control = new StubControl();

    @Test
    void listsTheCatalogOfTheControlPlane() {
        control.answer(
                "GET /api/catalog?domain=north&mission=weeding",
                "[{'domain':'north','mission':'weeding','type':'Camera','entities':2,'events':7}]");

        for (String form : new String[] {"table", "name", "jsonpath={.types[*].events}"}) {
            assertThat(control.run("catalog", "--domain", "north", "--mission", "weeding", "-o", form))
                    .isZero();
        }

        assertThat(control.output())
                .containsPattern("north / weeding +Camera +2 +7 ")
                .contains("north/weeding/Camera\n7\n");
    }

    @Test
    void listsNoMoreTypesThanAreRequested() {
        control.answerPage("GET /api/catalog?limit=1", "[{'type':'Camera'},{'type':'Robot'}]", "?limit=1&page=2");

        assertThat(control.run("catalog", "--limit", "1", "-o", "name")).isZero();

        assertThat(control.output().lines())
                .containsExactly("-/-/Camera", "There are more than 1; --limit shows more of them.");
        assertThat(control.run("catalog", "--limit", "0")).isEqualTo(2);
    }
}
