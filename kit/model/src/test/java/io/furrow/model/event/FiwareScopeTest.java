package io.furrow.model.event;

import java.util.List;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class FiwareScopeTest {
    @Test
    void readsHeadersAsTheContextBrokerDoes() {
        assertThat(FiwareScope.of(" Agri ", " /plot1 ")).isEqualTo(new FiwareScope("agri", "/plot1"));
        assertThat(FiwareScope.of("agri", "/farm/north/")).isEqualTo(new FiwareScope("agri", "/farm/north"));
        assertThat(FiwareScope.of("agri", "//")).isEqualTo(new FiwareScope("agri", "/"));
        assertThat(FiwareScope.of(null, null)).isEqualTo(FiwareScope.DEFAULT);
        assertThat(FiwareScope.of("", " ")).isEqualTo(FiwareScope.DEFAULT);
    }

    @Test
    void givesNoTwoEntitiesOneIdentity() {
        assertThat(FiwareScope.of("agri", "/p").identity("urn:x|1")).isEqualTo("agri|/p|urn:x|1");
        assertThat(List.of(
                        new FiwareScope("a", "/").identity("b|c"),
                        new FiwareScope("a", "/|b").identity("c"),
                        new FiwareScope("a|/", "b").identity("c"),
                        new FiwareScope("a%7C/", "b").identity("c"),
                        new FiwareScope("", "/").identity("a|/|b|c")))
                .doesNotHaveDuplicates();
    }

    @Test
    void isReadFromTheIdentitiesOfItsEntities() {
        for (FiwareScope scope : List.of(
                FiwareScope.DEFAULT,
                new FiwareScope("agri", "/p"),
                new FiwareScope("a|b", "/100%"),
                new FiwareScope("a%7Cb", "/%25"))) {
            assertThat(FiwareScope.ofIdentity(scope.identity("urn:x|1"))).isEqualTo(scope);
            assertThat(FiwareScope.typeOf(scope.identity("a|b", "urn:x|1"), "urn:x|1"))
                    .isEqualTo("a|b");
            assertThat(FiwareScope.typeOf(scope.identity("urn:x|1"), "urn:x|1")).isEmpty();
        }
    }
}
