package io.furrow.simulators.fiware;

import java.util.Collection;

/** A refused request: the HTTP status and the two texts that Orion puts into {@code {"error", "description"}}. */
final class NgsiError extends Exception {
    private static final long serialVersionUID = 1;

    private final int status;
    private final String error;

    NgsiError(int status, String error, String description) {
        super(description);
        this.status = status;
        this.error = error;
    }

    static NgsiError badRequest(String description) {
        return new NgsiError(400, "BadRequest", description);
    }

    static NgsiError notJson() {
        return new NgsiError(400, "ParseError", "Errors found in incoming JSON buffer");
    }

    static NgsiError unsupported(String what) {
        return badRequest("not supported by the stand-in: " + what);
    }

    static NgsiError noService() {
        return badRequest("Service not found. Check your URL as probably it is wrong.");
    }

    static NgsiError noBody() {
        return new NgsiError(411, "ContentLengthRequired", "Zero/No Content-Length in PUT/POST/PATCH request");
    }

    static NgsiError noEntity() {
        return notFound("The requested entity has not been found. Check type and id");
    }

    static NgsiError noAttribute() {
        return notFound("The entity does not have such an attribute");
    }

    static NgsiError noSubscription() {
        return notFound("The requested subscription has not been found. Check id");
    }

    static NgsiError noType() {
        return notFound("Entity type not found");
    }

    static NgsiError noRegistration() {
        return notFound("The requested registration has not been found. Check id");
    }

    /** Of a batch. */
    static NgsiError noEntity(EntityUpdate request) {
        return notFound("do not exist: " + request.label() + " - [entity itself]");
    }

    private static NgsiError notFound(String description) {
        return new NgsiError(404, "NotFound", description);
    }

    static NgsiError badMethod() {
        return new NgsiError(405, "MethodNotAllowed", "method not allowed");
    }

    static NgsiError ambiguous() {
        return new NgsiError(409, "TooManyResults", "More than one matching entity. Please refine your query");
    }

    static NgsiError tooLarge(long bytes, long limit) {
        return new NgsiError(413, "RequestEntityTooLarge", "payload size: " + bytes + ", max size supported: " + limit);
    }

    static NgsiError badMediaType(String type) {
        return new NgsiError(415, "UnsupportedMediaType", "not supported content type: " + type);
    }

    static NgsiError exists() {
        return unprocessable("Already Exists");
    }

    static NgsiError noAttributes(EntityUpdate request, Collection<String> names) {
        return unprocessable("do not exist: " + request.label() + listed(names));
    }

    static NgsiError attributesExist(EntityUpdate request, Collection<String> names) {
        return unprocessable(
                "one or more of the attributes in the request already exist: " + request.label() + listed(names));
    }

    private static String listed(Collection<String> names) {
        return " - [ " + String.join(", ", names) + " ]";
    }

    private static NgsiError unprocessable(String description) {
        return new NgsiError(422, "Unprocessable", description);
    }

    /** Some of what the request asked for was done, the rest was not. */
    static NgsiError partial(String description) {
        return new NgsiError(422, "PartialUpdate", description);
    }

    int status() {
        return status;
    }

    String error() {
        return error;
    }
}
