package io.furrow.control.rest;

import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerResponseContext;
import jakarta.ws.rs.container.ContainerResponseFilter;
import jakarta.ws.rs.core.Link;
import jakarta.ws.rs.core.MultivaluedMap;
import jakarta.ws.rs.core.UriInfo;

import io.furrow.control.rest.description.ApiDescription;
import io.furrow.model.ngsi.NgsiJson;

/**
 * Writes lists, and the features of a GeoJSON collection: the page of {@code limit} elements that a request asks for,
 * with links to the pages beside it.
 */
final class PageFilter implements ContainerResponseFilter {
    private static final String LIMIT = "limit";
    private static final String PAGE = "page";
    private static final String FEATURES = "features";

    private final ApiDescription description;

    PageFilter(ApiDescription description) {
        this.description = description;
    }

    @Override
    public void filter(ContainerRequestContext request, ContainerResponseContext response) {
        if (response.getEntity() instanceof ArrayNode list) {
            response.setEntity(NgsiJson.write(page(request, response, list)));
        } else if (response.getEntity() instanceof ObjectNode collection
                && collection.get(FEATURES) instanceof ArrayNode list) {
            collection.set(FEATURES, page(request, response, list));
            response.setEntity(NgsiJson.write(collection));
        }
    }

    private JsonNode page(ContainerRequestContext request, ContainerResponseContext response, ArrayNode list) {
        MultivaluedMap<String, String> query = request.getUriInfo().getQueryParameters();
        long limit = query.containsKey(LIMIT)
                ? Long.parseLong(query.getFirst(LIMIT))
                : description
                        .operation(request)
                        .map(operation -> operation.parameters().get(LIMIT))
                        .map(schema -> schema.path("default").asLong(list.size()))
                        .orElse((long) list.size());
        long page = query.containsKey(PAGE) ? Long.parseLong(query.getFirst(PAGE)) : 1;
        long from = Math.min(list.size(), (page - 1) * limit);
        long to = Math.min(list.size(), from + limit);
        List<Link> links = new ArrayList<>();
        if (page > 1) {
            links.add(link(request.getUriInfo(), page - 1, "prev"));
        }
        if (to < list.size()) {
            links.add(link(request.getUriInfo(), page + 1, "next"));
        }
        links.forEach(link -> response.getHeaders().add("Link", link));
        ArrayNode elements = NgsiJson.array();
        for (long i = from; i < to; i++) {
            elements.add(list.get((int) i));
        }
        return elements;
    }

    /** Returns a link relative to the request, because of proxies and versions. */
    private static Link link(UriInfo uri, long page, String relation) {
        String query =
                uri.getRequestUriBuilder().replaceQueryParam(PAGE, page).build().getRawQuery();
        return Link.fromUri("?" + query).rel(relation).build();
    }
}
