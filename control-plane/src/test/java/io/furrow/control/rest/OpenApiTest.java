package io.furrow.control.rest;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.Stream;

import com.networknt.schema.JsonSchemaFactory;
import com.networknt.schema.SpecVersion;
import org.glassfish.jersey.server.model.Resource;
import org.glassfish.jersey.server.model.ResourceMethod;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class OpenApiTest {
    @Test
    void describesEveryRouteAndNoOther() throws Exception {
        Set<String> routes = new TreeSet<>();
        for (Class<?> type : resources()) {
            add(Resource.from(type), "", routes);
        }

        assertThat(OpenApiDocument.read().operations()).isEqualTo(routes);
    }

    /** By the schema of schemas, each on its own. */
    @Test
    void hasSchemasThatAreSome() throws Exception {
        var meta = JsonSchemaFactory.getInstance(SpecVersion.VersionFlag.V202012)
                .getSchema(java.net.URI.create("https://json-schema.org/draft/2020-12/schema"));
        OpenApiDocument.read()
                .json()
                .at("/components/schemas")
                .forEach(schema -> assertThat(meta.validate(schema)).isEmpty());
    }

    @Test
    void namesEachOperationOnce() throws Exception {
        List<String> ids = OpenApiDocument.read().json().findValuesAsText("operationId");

        assertThat(ids)
                .doesNotHaveDuplicates()
                .hasSameSizeAs(OpenApiDocument.read().operations());
    }

    /** All classes of the package that have a path. */
    private static List<Class<?>> resources() throws Exception {
        Path folder =
                Path.of(RestApi.class.getResource("RestApi.class").toURI()).getParent();
        List<Class<?>> types = new ArrayList<>();
        try (Stream<Path> files = Files.list(folder)) {
            for (Path file :
                    files.filter(each -> each.toString().endsWith(".class")).toList()) {
                String name = file.getFileName().toString().replace(".class", "");
                Class<?> type = Class.forName(RestApi.class.getPackageName() + "." + name);
                if (type.isAnnotationPresent(jakarta.ws.rs.Path.class)) {
                    types.add(type);
                }
            }
        }
        return types;
    }

    private static void add(Resource resource, String before, Set<String> routes) {
        String path = (before + "/" + (resource.getPath() == null ? "" : resource.getPath()))
                .replaceAll("/+", "/")
                .replaceAll("\\{([a-z]+):[^}]*}", "{$1}")
                .replaceAll("(?<=.)/$", "");
        for (ResourceMethod method : resource.getResourceMethods()) {
            routes.add(method.getHttpMethod() + " " + path);
        }
        resource.getChildResources().forEach(child -> add(child, path, routes));
    }
}
