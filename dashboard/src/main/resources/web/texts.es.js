/** The texts of `texts.js` in Spanish: the same names, the same values in braces. `words`, `sentences`, `details` and `refusals` translate what devices and the server say in English. */

export const texts = {
  app: {
    title: 'Furrow',
    skip: 'Saltar al contenido', skipPanel: 'Saltar a alarmas y dispositivos', skipTimeline: 'Saltar a la línea de tiempo',
    find: 'Buscar un dispositivo, una parcela o una alarma', findShort: 'Buscar …',
    live: 'En vivo', notConnected: 'Sin conexión',
    replayOf: 'Reproducción de {mission} · {day}',
    toLive: 'Volver al vivo',
    liveView: 'Esta vista es en vivo. El mapa muestra una reproducción de {mission}.', toReplay: 'A la reproducción',
    scope: 'Qué se muestra', others: '{count} fuera de {scope}: mostrar todo', only: 'Solo {scope}.',
    alarms: '{count alarma abierta|alarmas abiertas}',
    places: 'Lugares',
    settings: 'Ajustes',
    signOut: 'Cerrar sesión',
    scheme: 'Aspecto',
    schemes: { system: 'Como el sistema', dark: 'Oscuro', light: 'Claro', sunlight: 'Pleno sol, alto contraste' },
    language: 'Idioma',
    allDomains: 'Todos los dominios',
    viewFailed: 'Esta parte de la página no se pudo cargar: {reason}. Recargue la página; si el problema persiste, consulte el registro del panel.',
    lost: 'Sin conexión desde hace {duration}, reintentando. Los datos mostrados son de las {time}.',
    lostNever: 'Sin conexión desde hace {duration}, reintentando. {reason}',
    away: 'La conexión se perdió de {from} a {to}.',
    gap: '{count registro perdido|registros perdidos}.',
    panel: 'Alarmas y dispositivos',
    timeline: 'Línea de tiempo',
    csv: 'Guardar como CSV', csvOf: 'Guardar como CSV: {table}',
    enteredReplay: 'Se muestra la reproducción de {mission}. No se envían órdenes.',
    enteredLive: 'Se muestran datos en vivo.',
  },

  words: {
    critical: 'crítica', major: 'grave', minor: 'leve', warning: 'aviso',
    'missing devices': 'faltan dispositivos', 'silent device': 'dispositivo sin señal', 'silent mission': 'misión sin señal', 'silent farm': 'finca sin señal', collision: 'colisión',
    'predicted encounter': 'encuentro previsto', 'suspect sensor': 'sensor sospechoso', 'clock behind': 'reloj atrasado', fault: 'avería',
    viewer: 'observador', operator: 'operador', admin: 'administrador',
    stop: 'parar', resume: 'continuar', start: 'iniciar', create: 'crear', change: 'cambiar', delete: 'eliminar', import: 'importar', rename: 'renombrar', end: 'terminar', pause: 'pausar', seek: 'ir a', speed: 'velocidad', loop: 'bucle', step: 'paso',
    acknowledge: 'reconocer', mute: 'silenciar', unmute: 'dejar de silenciar', close: 'cerrar',
    created: 'creada', changed: 'cambiada', deleted: 'eliminada', started: 'iniciada', stopped: 'parada', sent: 'enviada', imported: 'importadas', renamed: 'renombrada', ended: 'terminada', acknowledged: 'reconocida', closed: 'cerrada', muted: 'silenciada', unmuted: 'sin silenciar',
    running: 'en marcha', working: 'trabajando', idle: 'inactivo', charging: 'cargando', paused: 'en pausa',
    temperature: 'temperatura', 'soil temperature': 'temperatura del suelo', 'dew point': 'punto de rocío', 'wind speed': 'velocidad del viento', heading: 'rumbo', 'wind direction': 'dirección del viento',
    humidity: 'humedad', 'relative humidity': 'humedad relativa', 'soil moisture': 'humedad del suelo', battery: 'batería', 'battery level': 'batería', pressure: 'presión', 'atmospheric pressure': 'presión atmosférica', altitude: 'altitud',
    illuminance: 'iluminancia', voltage: 'tensión', precipitation: 'precipitación', rainfall: 'lluvia', 'solar radiation': 'radiación solar', location: 'posición', position: 'posición', state: 'estado', status: 'estado', mode: 'modo', mission: 'misión', image: 'imagen', latitude: 'latitud', longitude: 'longitud',
    domain: 'dominio', template: 'plantilla', description: 'descripción', version: 'versión', name: 'nombre', duration: 'duración', analytics: 'análisis', field: 'parcela', fields: 'parcelas', events: 'eventos', markers: 'marcas', from: 'desde', to: 'hasta', kind: 'clase',
    'save-template': 'guardar plantilla', 'delete-template': 'eliminar plantilla',
  },

  commands: { stop: 'parar', resume: 'continuar', on: 'encender', off: 'apagar', restart: 'reiniciar' },
  reported: { running: 'en marcha', working: 'trabajando', moving: 'en movimiento', stop: 'parado', stopped: 'parado', paused: 'en pausa', idle: 'inactivo', charging: 'cargando', on: 'encendido', off: 'apagado', failed: 'fallido' },

  sentences: {
    'collision-many': '{affected pareja más|parejas más} de {group} {affected: está|están} demasiado cerca',
    'predicted-encounter': '{first} y {second} se acercarán a {meters}', 'predicted-encounter-many': 'Se {affected: prevé|prevén} {affected encuentro más|encuentros más} de {group}',
    'suspect-sensor': '{first} se desvía de los demás sensores de {group}', 'suspect-sensor-many': '{affected sensor más|sensores más} de {group} se {affected: desvía|desvían} de los demás',
    'clock-behind': 'Los informes de {first} llegan {late} tarde y se descartan: compruebe su reloj y su conexión', 'clock-behind-many': 'Los informes de {affected dispositivo más|dispositivos más} de {group} llegan demasiado tarde y se descartan',
    'missing-devices-many': '{affected: Falta|Faltan} {affected} de {total} dispositivos de {group}: {devices}',
    'silent-device-many': '{affected} de {total} dispositivos de {group} sin señal: {devices}',
    'silent-mission-many': '{affected} de {total} dispositivos de {group} sin señal: probablemente el lugar o su conexión, no los dispositivos',
    'silent-farm-many': '{affected} de {total} dispositivos de la finca sin señal: no llega nada o acaba de volver',
  },
  details: {
    'not-provisioned': 'no está registrado: {failure}', 'no-report': 'todavía no ha informado', 'not-registered': 'el IoT Agent no lo conoce',
    'unreadable-payload': '{count de sus mensajes no se pudo|de sus mensajes no se pudieron} leer, el último: {time}: {reason}', 'foreign-topic': 'publicó {count vez|veces} en {topic}, donde no puede; la última: {time}',
    'unknown-user': 'su usuario {user} no existe, o ya no, y fue rechazado {count vez|veces}; la última: {time}', 'wrong-password': 'su contraseña fue rechazada {count vez|veces}; la última: {time}',
    'no-login': 'no se ha conectado al broker MQTT desde {time}', 'no-measure': 'se conectó ({time}) y no ha enviado nada desde entonces', 'not-simulated': 'nada lo simula: inicie ./furrow up con --simulate-devices, o ./furrow device-host',
    'connector-failed': 'El conector {connector} falló: {failure}. Corríjalo y después: {command}',
    'devices-retained': '{accounts cuenta|cuentas} MQTT, {devices dispositivo|dispositivos} y {groups grupo|grupos} del IoT Agent permanecen aunque este Kafka no los contiene: está vacío, o se crearon para otro Kafka ({names}). Compruebe --kafka; si Kafka perdió sus datos, inicie de nuevo sus misiones; --forget-devices elimina los que no se desean',
    'devices-undecided': 'El estado deseado de {count dispositivo|dispositivos} no se puede leer ({devices}): sus registros en service.devices, o las listas de sus misiones, son de otra versión. Conservan credenciales y registro, pero no reciben cambios; actualice Furrow aquí, o inicie de nuevo sus misiones',
  },
  groups: { mission: 'la misión {name}', domain: 'el dominio {name}', field: '{name}', none: 'ninguna misión' },

  refusals: {
    'not-json': 'la petición no es JSON', 'not-a-request': 'no es una petición', 'unknown-command': 'no existe la orden', 'missing-member': 'falta un dato', 'wrong-member': 'un dato no es válido', 'illegal-name': 'el nombre no es válido',
    'domain-exists': 'el dominio ya existe', 'unknown-domain': 'no existe el dominio', 'missions-running': 'hay misiones en marcha en el dominio',
    'mission-exists': 'la misión ya existe', 'unknown-mission': 'no existe la misión', 'mission-running': 'la misión está en marcha', 'mission-not-running': 'la misión no está en marcha', 'name-taken': 'el nombre pertenece a una misión de otro dominio', 'unknown-template': 'no existe la plantilla',
    'device-taken': 'otra misión en marcha tiene el dispositivo', 'unknown-device': 'no existe el dispositivo', 'ambiguous-device': 'varias fincas tienen un dispositivo con este identificador', 'no-credentials': 'el dispositivo tiene sus propias credenciales',
    'unknown-field': 'no existe la parcela', 'unknown-replay': 'no existe la reproducción', 'replay-exists': 'la reproducción ya existe', 'unknown-alarm': 'no existe la alarma',
    'wrong-state': 'su estado no lo permite', outdated: 'alguien lo cambió entretanto; vuelva a cargarlo', 'too-large': 'es demasiado grande', 'quota-exceeded': 'se alcanzó el límite', 'request-id-reused': 'el identificador pertenece a otra petición',
    overloaded: 'el servidor no acepta más peticiones ahora; inténtelo más tarde', 'internal-error': 'el servidor falló y no cambió nada', 'not-ready': 'el servidor todavía se está iniciando; inténtelo más tarde',
    unauthorized: 'el token de acceso no es válido', forbidden: 'su rol no lo permite', 'kafka-away': 'Kafka no responde', 'mongodb-away': 'MongoDB no responde', 'no-mongodb': 'no hay MongoDB, así que no se guarda nada', 'control-plane-away': 'el plano de control no responde',
    'unknown-topic': 'no existe el tema', 'topic-not-allowed': 'su rol no permite leer el tema', 'too-much': 'hay demasiados datos', 'too-slow': 'la lectura tardó demasiado', 'too-many-streams': 'hay demasiadas conexiones abiertas', 'unknown-image': 'no existe la imagen',
  },

  views: { map: 'Mapa', missions: 'Misiones', replays: 'Reproducciones', analyses: 'Análisis', history: 'Historial', topics: 'Temas', platform: 'Plataforma', report: 'Informe' },

  signIn: {
    title: 'Iniciar sesión',
    token: 'Token de acceso',
    hint: 'Pida un token al responsable del plano de control.',
    submit: 'Entrar',
    wrong: 'El plano de control no conoce este token.',
    notByProxy: 'El proxy no ha iniciado su sesión. Pregunte el motivo al responsable del proxy.',
    byProxy: 'Entrar de nuevo', or: 'o con un token de acceso', submitToken: 'Usar el token',
  },

  opening: {
    away: 'La finca todavía no se puede mostrar: {reason}',
    again: 'Se reintenta automáticamente.',
    retry: 'Probar ahora',
  },

  units: {
    second: 's', minute: 'min', hour: 'h', day: 'd', meter: 'm', kilometer: 'km', hectare: 'ha', millimeter: 'mm', meterPerSecond: 'm/s', kilometerPerHour: 'km/h',
    celsius: '°C', percent: '%', degree: '°', hectopascal: 'hPa', lux: 'lx', volt: 'V', ampere: 'A', watt: 'W', wattPerSquareMeter: 'W/m²',
    byte: 'B', kilobyte: 'kB', megabyte: 'MB', gigabyte: 'GB', terabyte: 'TB',
  },

  format: { ago: 'hace {duration}', yes: 'sí', no: 'no', time: 'AAAA-MM-DD HH:MM:SS' },

  errors: {
    noAnswer: 'El servidor no responde. Compruebe que ./furrow dashboard está en marcha y que esta máquina llega a él.',
    status: 'El servidor rechazó la petición con el estado {status}.',
  },

  kinds: { robot: 'robot', sensor: 'sensor', camera: 'cámara', other: 'dispositivo' },
  states: { ok: 'informa', attention: 'requiere atención', stale: 'sin señal', off: 'apagado' },

  // ------------------------------------------------------------------------------------------------------------------

  map: {
    label: 'Mapa de la finca. Las flechas lo mueven, más y menos cambian la escala; la tabla contiene lo mismo en filas.',
    controls: 'Mapa', zoomIn: 'Acercar', zoomOut: 'Alejar', fit: 'Mostrar toda la finca', farms: 'Fincas', layers: 'Qué se muestra', table: 'El mapa como tabla', closeTable: 'Cerrar la tabla',
    tables: { devices: 'Dispositivos', encounters: 'Encuentros', fields: 'Parcelas', coverages: 'Superficie trabajada' },
    cells: { worked: 'trabajado', 'worked-again': 'trabajado de nuevo', gap: 'hueco' }, toggleCells: 'Mostrar u ocultar lo trabajado', workedShare: '{share} trabajado',
    base: { title: 'Mapa base', none: 'ninguno', server: 'del servidor', address: 'de {host}', file: 'Elegir un archivo PMTiles …', hint: 'Teselas de imagen; el archivo se guarda en este navegador y funciona sin conexión. Las teselas de un servidor se muestran si --tiles de ./furrow dashboard, up o demo lo nombra: esta página no puede cargar imágenes de ningún otro.', remove: 'Quitar {file} de este navegador', noPictures: '{file} no contiene imágenes como teselas', failed: 'El mapa base no se puede mostrar: {reason}' },
    options: { trails: 'Recorridos', labels: 'Nombres', rows: 'Líneas de las parcelas' },
    legend: 'Leyenda', stopped: 'apagado o parado', encounter: 'encuentro', predicted: '{distance} en {time} s', apart: 'ahora {now}, mínimo {closest}', ended: 'llegaron a {closest}', closest: 'mínimo {distance}',
    devices: '{count dispositivo|dispositivos}', unverified: 'sin verificar', suspects: '{count sospechoso|sospechosos}', noAlarms: 'sin alarmas',
    cluster: '{count} dispositivos, pulse para abrir', oneSpot: '{count} dispositivos en el mismo punto',
    columns: { name: 'Nombre', kind: 'Tipo', state: 'Estado', latitude: 'Latitud', longitude: 'Longitud', position: 'Posición', speed: 'Velocidad', age: 'Último informe', pair: 'Dispositivos', phase: 'Fase', distance: 'Distancia', closest: 'Mínimo', field: 'Parcela', average: 'Media', devices: 'Dispositivos', suspects: 'Sospechosos', mission: 'Misión', hectares: 'Trabajado', share: 'Parte', overlap: 'De nuevo', gaps: 'Huecos', left: 'Tiempo restante' },
    speed: '{speed} m/s',
    phases: { predicted: 'previsto', started: 'demasiado cerca', ongoing: 'demasiado cerca', ended: 'terminado', crossed: 'cruzado' },
    faults: { 'no-number': 'no es un número', 'no-point': 'no es un punto', 'out-of-range': 'fuera del mapa', 'no-fix': 'sin señal de satélite' },
    moreRows: 'y {count} más; búsquelos para verlos',
    emptyTitle: 'Todavía no hay dispositivos', emptyText: 'Los dispositivos aparecen aquí cuando informan. Para iniciar dispositivos simulados:',
  },

  // ------------------------------------------------------------------------------------------------------------------

  draw: {
    title: 'Dibujar parcelas', open: 'Dibujar y cambiar parcelas', field: 'Parcela nueva', zone: 'Zona nueva', type: 'Escribir vértices', changeField: 'Cambiar una parcela …', done: 'Listo', save: 'Guardar', finish: 'Terminar', removeLast: 'Quitar el último vértice',
    attributes: 'Atributos y vértices', attributesOf: 'Atributos de {field}', newField: 'Parcela nueva', newZone: 'Zona nueva sin alarmas', chooseHint: 'Pulse una parcela para cambiarla, o dibuje una nueva.', drawHint: 'Pulse cada vértice; pulse de nuevo el primero para terminar. Retroceso quita el último.', shapeHint: 'Arrastre un vértice, arrastre un lado para añadir otro, arrastre el interior para mover el conjunto. Alt y una pulsación quitan un vértice.',
    crop: 'Cultivo', rowDirection: 'Dirección de las líneas', rowDirectionHint: 'Grados desde el norte en el sentido de las agujas del reloj. Vacío: no se dibujan líneas.', alongSide: 'Según el lado más largo', noDomain: 'ninguno', zoneHint: 'Los dispositivos dentro de una zona no producen encuentros. El trabajo que busca encuentros lee las zonas al iniciarse.', corners: 'Vértices', cornersLabel: 'Latitud y longitud de cada vértice', cornersHint: 'Un vértice por línea, en grados. Una línea vacía separa el borde de un hueco.',
    noCorner: 'La línea {line} no es un vértice. Escriba latitud y longitud en grados, por ejemplo 40.3123456, -3.4823456.', rings: 'El contorno tiene {count anillo|anillos}. Sepárelos con líneas vacías, y no los vértices de un mismo anillo.',
    faults: {
      crosses: 'El borde se cruza consigo mismo en {place}. Mueva un vértice para evitarlo.', corners: 'Una parcela necesita al menos tres vértices. Añada alguno.',
      outside: 'Un vértice está fuera del mapa: las latitudes van de −85,05 a 85,05 y las longitudes de −180 a 180.', many: 'El contorno tiene más de 5000 vértices. Impórtelo de un archivo.',
    },
    drawn: '{field} se dibujó', renamed: '{field} cambió de nombre', deleted: '{field} se eliminó', moved: '{field} se movió', changed: '{field} se cambió', ended: '{field} terminó', saved: '{field} se ha guardado.', undo: 'Deshacer: {change}', undone: 'Deshecho: {change}.', undoAnyway: 'Deshacer ambos',
    changedSince: 'La parcela se ha cambiado de nuevo desde entonces, aquí o por otra persona. Deshacer también anula ese cambio.', conflict: 'Alguien ha cambiado {field} mientras tanto. Cancele y cámbiela tal como es ahora.',
  },

  // ------------------------------------------------------------------------------------------------------------------

  cards: {
    title: 'Dispositivos', silent: '{count dispositivo sin señal o apagado|dispositivos sin señal o apagados}', count: '{count} · {reporting informa|informan}', found: '{found} de {count}', unknown: '{device} nunca ha informado o fue eliminado.', filter: 'Mostrar solo', loading: 'Se leen los dispositivos',
    state: 'Estado', fieldMean: 'En la parcela', suspect: 'dudoso', noPosition: 'sin posición', details: 'Todos los atributos de {name}',
    line: '{label}: ahora {now} {unit}, entre {min} y {max} {unit}',
    lineConstant: '{label}: {now} {unit} todo el tiempo',
    tooLarge: 'Demasiado grande para mostrarlo', omitted: 'Sin mostrar: {count atributo|atributos} más.',
    noPicture: 'Todavía no hay ninguna imagen guardada', pictureOf: 'Imagen de {age}', pictureAlt: 'Imagen más reciente de {name}', pictureFailed: 'Sin imagen: {reason}',
    recorded: 'grabado, no enviado', confirm: '¿Enviar «{command}» a {name}?', refused: '{command} no se envió: {reason}',
    outcomes: { pending: '{command} enviado {ago}, todavía sin respuesta', ok: '✓ {command}, {ago}', failed: '✗ {command} falló {ago}. {info}', unanswered: '{command}: sin respuesta desde {ago}' },
    connection: {
      report: 'Último informe de {time}, recibido {offset} después.', ahead: 'Último informe de {time}: su reloj va {offset} adelantado.',
      unregistered: 'El IoT Agent no lo conoce.', login: 'Conectado al bróker MQTT a las {time}.', noLogin: 'No se ha conectado al bróker MQTT desde {time}.',
      password: 'Su contraseña fue rechazada {times} {time}.', user: 'Su usuario {user} no existe o ya no existe, y fue rechazado {times} {time}.',
      foreign: 'Publicó {times} {time} en {topic}, donde no puede.', once: 'una vez, a las', times: '{count} veces, la última a las', unreadable: '{count de sus mensajes no se pudo|de sus mensajes no se pudieron} leer, el último a las {time}: {reason}. Empezaba con {payload}',
    },
    none: 'Todavía no hay dispositivos', noneHint: 'La ficha de un dispositivo aparece aquí cuando informa.',
    noneYet: 'Todavía nada en este momento', noneYetHint: 'La reproducción todavía no tiene informes, o no tiene ninguno.',
    noMatch: 'Ningún dispositivo coincide', noMatchHint: 'Borre la búsqueda o los filtros de arriba para ver todos los dispositivos.',
  },

  stopAll: {
    title: 'Parar todos los robots', short: 'Parar todos', again: 'Parar los demás de nuevo', none: 'No se conoce ningún robot que se pueda parar.',
    text: 'Envía la parada a cada robot de todos los dominios, sea cual sea la búsqueda o la selección; los robots de misiones paradas ya están apagados.',
  },

  // ------------------------------------------------------------------------------------------------------------------

  alarms: {
    apart: '{first} y {second} están a {now}, mínimo {closest}', within: '{first} y {second} llegaron a {closest}',
    title: 'Alarmas', reading: 'Se leen las alarmas …', failed: 'Las alarmas no se pueden leer: {reason}', open: '{count abierta|abiertas}', none: 'Sin alarmas abiertas', noMatch: 'Ninguna alarma abierta coincide con la búsqueda.', noneHere: 'Aquí no hay alarmas abiertas.', quiet: '{count reconocida, silenciada o explicada|reconocidas, silenciadas o explicadas} por otra', liveInReplay: 'En vivo, no de la reproducción: {count alarma|alarmas}', further: 'Mostrar {count} más',
    acknowledge: 'Reconocer', more: 'Silenciar o cerrar', mute10: 'Silenciar 10 minutos', mute60: 'Silenciar una hora', mute480: 'Silenciar 8 horas', unmute: 'Dejar de silenciar', close: 'Cerrar',
    seen: '{count} veces', affected: '{count} de {total}', by: 'reconocida por {user}', mutedUntil: 'silenciada hasta {time}', inhibited: 'explicada por otra alarma',
    announced: 'Alarma nueva, {severity}: {text}', notify: 'Avisarme cuando esta página esté en segundo plano', notification: 'Furrow: alarma {severity}',
  },

  // ------------------------------------------------------------------------------------------------------------------

  topics: {
    hint: 'Marque un tema para ver sus registros; el signo del mapa muestra solo un dominio o una misión en el mapa.',
    sections: { results: 'Resultados', domains: 'Dominios y misiones', all: 'Todo lo informado', replays: 'Reproducciones', service: 'Peticiones y estados', other: 'Otros temas' },
    rate: '{rate}/s', noneYet: 'todavía sin registros', noDomains: 'Todavía no hay ningún dominio. Cree uno en la vista de misiones.',
    showOnly: 'Mostrar solo {name} en el mapa', showAll: 'Volver a mostrar todo en el mapa',
    records: 'Registros', noneChosen: 'Ningún tema elegido', noneChosenHint: 'Elija uno o varios; sus registros aparecen aquí, primero los más recientes.',
    columns: { time: 'Hora', topic: 'Tema', key: 'Clave', value: 'Valor' },
    pause: 'Pausa', goOn: 'Continuar', paused: 'en pausa', findKey: 'Solo claves con …', count: '{count más reciente|más recientes}', quiet: 'sin registros desde que se eligió el tema', noMatch: 'ninguna clave coincide', gaps: '{count perdido|perdidos}', waiting: 'se intenta conectar',
    open: 'Registro de {time}', cut: 'demasiado grande para mostrarlo: {size}', deleted: 'eliminado', shortened: 'acortado, {size} en total', where: 'Partición {partition}, offset {offset}, clave {key}', headers: 'Cabeceras',
  },

  // ------------------------------------------------------------------------------------------------------------------

  credentials: {
    title: 'Credenciales de {mission}', hint: 'Los dispositivos reales informan por MQTT con estas credenciales, válidas hasta que se pare la misión. Quien tenga una puede informar como ese dispositivo.', none: 'La misión no tiene ningún dispositivo real con credenciales de Furrow.',
    download: 'Descargar como CSV ({count})', code: 'Credenciales de {device} como código para una cámara', sends: 'Puede enviar: {names}',
    facts: { host: 'Bróker', port: 'Puerto', tls: 'TLS', user: 'Usuario', password: 'Contraseña', measures: 'Publica en', commands: 'Se suscribe a', results: 'Responde a órdenes en' },
  },
  missions: {
    tabs: { missions: 'Misiones', domains: 'Dominios y parcelas', audit: 'Quién ordenó qué' },
    new: 'Misión nueva', create: 'Crear', cancel: 'Cancelar', name: 'Nombre', nameHint: '1 a 64 de A–Z a–z 0–9 _ -', domain: 'Dominio', template: 'Plantilla', chooseTemplate: 'Elija una plantilla …', templateVersion: '{template}, versión {version}',
    noTemplateList: 'Las plantillas no se pueden listar: {reason}', ownDevices: 'Sin plantilla: dispositivos propios', ids: 'Dispositivos que ya tienen credenciales', ownHint: 'Identificadores de entidad, uno por línea. Vacío si no hay ninguno.', type: 'Tipo', count: 'Cuántos', period: 'Un informe cada', simulated: 'Simulados', simulatedHint: 'Necesita un equipo de dispositivos simulados; un dispositivo real cuenta desde su primer informe', moreDevices2: 'Dispositivos de otro tipo', lessDevices: 'Quitar estos dispositivos', simulatedTemplate: 'Sus dispositivos son simulados', minutes: 'Duración en minutos', minutesHint: 'Vacío: hasta que se pare', startNow: 'Iniciarla enseguida',
    columns: { mission: 'Misión', domain: 'Dominio', template: 'Plantilla', state: 'Estado', since: 'Desde', start: 'Iniciada', devices: 'Dispositivos', confirmed: 'En el estado deseado' },
    none: 'Todavía no hay misiones', noneHint: 'Una misión dice qué dispositivos trabajan dónde. Cree una a partir de una plantilla.',
    states: { created: 'sin iniciar', starting: 'iniciándose', running: 'en marcha', stopping: 'parándose', stopped: 'parada', failed: 'fallida' },
    confirmed: '{confirmed} de {devices dispositivo|dispositivos}', missing: '{count ausente|ausentes}', since: 'desde hace {age}', notYet: 'todavía no', progress: 'Dispositivos en el estado deseado',
    startedAt: 'iniciada {time}', lasts: 'durante {duration}', left: 'quedan {duration}', start: 'Iniciar', stop: 'Parar', delete: 'Eliminar', replay: 'Reproducir', report: 'Informe',
    credentials: 'Credenciales', startTitle: '¿Iniciar {mission}?', stopTitle: '¿Parar {mission}?', stopText: 'Los dispositivos simulados se apagan; las credenciales de los reales dejan de valer hasta que se inicie de nuevo. Lo grabado se conserva.', deleteTitle: '¿Eliminar {mission}?', deleteText: 'Se eliminan su plan y sus dispositivos. Lo grabado se conserva en MongoDB.',
    devices: 'Dispositivos', deviceColumns: { device: 'Dispositivo', state: 'Estado', health: 'Salud', battery: 'Batería', seen: 'Último informe', audit: 'Órdenes' }, onMap: 'Mostrar {device} en el mapa', auditOfDevice: 'Quién dio órdenes a {device}',
    viewer: 'Puede verlo todo. Las órdenes requieren el papel de operador', noDevicesYet: 'Se crean sus dispositivos.', planned: '{count dispositivo previsto|dispositivos previstos}, se crean al iniciarse.', moreDevices: 'y {count} más',
    check: 'Comprobación de cada dispositivo', unnamed: 'Dispositivo', levels: { ok: 'en orden', unknown: 'desconocido', warning: 'requiere atención', problem: 'impide el inicio' },
    checkGood: '{count} de {count} en orden', checkBad: '{bad} de {count} {bad: requiere|requieren} atención', checkProblem: '{problems} de {count} {problems: impide|impiden} el inicio', checkProblemMore: '{problems} de {count} {problems: impide|impiden} el inicio, {bad} más {bad: requiere|requieren} atención',
    findings: {
      made: '{count registrado|registrados} al iniciarse la misión, cada uno con credenciales', simulated: '{count simulado|simulados} al iniciarse la misión', neverSeen: 'nunca ha informado, quizá no esté al alcance', seen: 'informó {ago}', silent: 'sin señal {ago}', off: 'apagado; la misión lo enciende',
      noBattery: 'no informa de la batería', battery: 'batería {percent} %', batteryLow: 'batería baja, {percent} %', used: 'trabaja en la misión {mission}',
      noPosition: 'no se conoce su posición', noFields: 'el dominio no tiene parcelas', noSuchField: 'no existe la parcela {field}', inside: 'en {field}', outside: 'fuera de las parcelas del dominio',
    },
    audit: 'Quién ordenó qué', noAudit: 'Nadie ha dado todavía ninguna orden.', noAuditOf: 'Nadie le ha dado ninguna orden.', noAuditYet: 'No hay nada suyo entre las órdenes más recientes.', showOlder: 'Mostrar anteriores', readingOlder: 'Se leen las anteriores …', noOlder: 'No hay anteriores.', auditOf: { mission: 'Misión', device: 'Dispositivo', all: 'todo' }, auditColumns: { time: 'Cuándo', user: 'Quién', command: 'Orden', about: 'Sobre', result: 'Resultado' },
    targets: { mission: 'misión', domain: 'dominio', replay: 'reproducción', alarm: 'alarma', device: 'dispositivo', field: 'parcelas', marker: 'marca', other: 'otro' }, refusedBecause: 'rechazada: {reason}',
    domains: 'Dominios', newDomain: 'Dominio nuevo', noDomains: 'Todavía no hay dominios', noDomainsHint: 'Un dominio es una finca, o parte de ella; las misiones y las parcelas le pertenecen.', domainId: 'Nombre en los temas', domainName: 'Nombre para las personas', description: 'Descripción',
    countMissions: '{count misión|misiones}', countFields: '{count parcela|parcelas}', deleteDomain: 'Eliminar el dominio {domain}', deleteDomainEmpty: 'No tiene misiones ni parcelas.', deleteDomainText: 'Elimina {missions} con todos sus dispositivos, y termina {fields}. Las grabaciones y los resultados se conservan.', deleteDomainForce: 'Parar lo que está en marcha: {missions}',
    fields: 'Parcelas', noFields: 'Todavía no hay parcelas', noFieldsHint: 'Importe los bordes de las parcelas como GeoJSON, o suelte aquí un archivo; para cada una se calculan medias y presencia.', fieldColumns: { field: 'Parcela', domain: 'Dominio', kind: 'Tipo', from: 'Desde' },
    fieldActs: { rename: 'Renombrar {field}', end: 'Terminar {field}', delete: 'Eliminar {field}' }, rename: 'Renombrar', renameHint: 'El identificador se conserva. La próxima importación le da el nombre de su archivo.', end: 'Terminar', endAt: 'Cuándo', endHint: 'Vacío: ahora',
    endText: 'Desde entonces no tiene medias ni estancias. Los resultados anteriores se conservan, y una reproducción de un tiempo anterior usa la parcela como era.',
    deleteFieldText: 'Se eliminan todas sus versiones. Al deshacer se escriben de nuevo, hasta que se cierre esta página. Los resultados guardados se conservan. Para conservar su historia, termínela.',
    lostDomain: '{domain} no existe', field: 'parcela', zone: 'zona sin alarmas', always: 'siempre', importFields: 'Importar parcelas', import: 'Importar', file: 'Archivo', fileHint: 'GeoJSON con polígonos, o un GeoPackage con una capa; como máximo 16 MiB. Shapefiles: ./furrow fields import.', asFeaturesSay: 'como indique cada elemento', close: 'Cerrar',
    previewFields: 'Superficies en el archivo: {count}', previewSome: 'Superficies en el archivo: {areas}. Otros elementos, que se rechazarán: {others}', previewGeoPackage: 'Un GeoPackage lo lee el servidor.', tooLarge: 'El archivo tiene {size} MiB; se aceptan como máximo 16.', imported: 'Importadas: {imported}. Sin cambios: {unchanged}', feature: 'Elemento {number} {id}', noGeoJson: 'El archivo no es un GeoJSON.', refusedFields: '{count rechazada|rechazadas}', mendedFields: '{count reparada|reparadas}',
  },

  // ------------------------------------------------------------------------------------------------------------------

  replays: {
    title: 'Reproducciones',
    lead: 'Reproduzca de nuevo los informes de las misiones: en el mapa, en las fichas y para los análisis.',
    running: 'En marcha',
    recorded: 'Misiones grabadas',
    none: 'Todavía no hay misiones guardadas',
    noneHint: 'Con MongoDB se guarda todo lo que informa una misión desde su inicio. Inicie una, y aparecerá aquí medio minuto después.',
    noneButton: 'A las misiones',
    choose: 'Elegir {mission}',
    choice: 'Misión', when: 'Cuándo', length: 'Duración', devices: 'Dispositivos', events: 'Eventos', density: 'En el tiempo',
    now: 'grabándose', wrongClock: 'Más de un año: el reloj de un dispositivo estaba mal.',
    chooseOne: 'Elija una misión, o varias para reproducirlas con un mismo reloj.',
    plan: 'Reproducción nueva',
    planOf: 'Reproducción de {missions}',
    oneClock: 'Con un mismo reloj, todas muestran la misma hora en cada momento.',
    from: 'Desde ({zone})', to: 'Hasta ({zone})', wrongRange: 'El final debe ser posterior al principio.',
    at: 'En', speed: 'Velocidad', times: '{speed} ×', fastest: 'lo más rápido posible',
    analytics: 'Con análisis', analyticsHint: 'Encuentros, medias, presencia y superficies trabajadas se calculan de nuevo y se muestran con la reproducción.',
    loop: 'Repetir',
    skip: 'Acortar a 30 s los tramos sin eventos',
    start: 'Iniciar la reproducción', starting: 'Se inicia …',
    notPlayed: 'Ningún trabajo reproduce esto. Compruebe que el trabajo replay está en marcha: ./furrow replay list muestra su estado.',
    viewer: 'Los observadores pueden ver reproducciones en marcha. Iniciar una requiere el papel de operador.',
    noRunning: 'No hay ninguna reproducción en marcha',
    noRunningHint: 'Elija abajo una misión e iníciela.',
    watch: 'Ver', watching: 'A la vista', stop: 'Parar', again: 'Reproducir de nuevo',
    copyLink: 'Copiar un enlace a este momento', copied: 'Copiado. El enlace lleva a {time}.', copyFailed: 'El navegador no puede copiar el enlace: {link}',
    position: '{position} de {length} a {speed} ×', positionFast: '{position} de {length}, lo más rápido posible',
    states: { starting: 'iniciándose', waiting: 'en espera', running: 'en marcha', paused: 'en pausa', ended: 'al final', stopped: 'parada', failed: 'fallida', over: 'terminada' },
    link: 'Un enlace a un momento de {missions}', linkHint: '{time}. Esa reproducción ha terminado; se puede iniciar ahí.', linkOver: '{time}. Esa reproducción ha terminado.', linkStart: 'Iniciarla ahí',
  },

  // ------------------------------------------------------------------------------------------------------------------

  timeline: {
    position: 'Cabezal',
    live: 'en vivo', lost: 'sin conexión',
    play: 'Reproducir', pause: 'Pausa', playHint: 'Reproducir o pausar (espacio)',
    stepBack: 'Paso atrás', stepBackHint: 'Un evento atrás (←); 10 s con mayúsculas',
    stepForward: 'Paso adelante', stepForwardHint: 'Un evento adelante (→); 10 s con mayúsculas',
    speed: 'Velocidad', times: '{speed} ×', fastest: 'máxima',
    loop: 'Bucle', loopHint: 'Repetir una parte ([ y ] fijan sus extremos; arrastre sobre las horas)',
    mark: 'Añadir una marca', markHint: 'Marcar este momento con una nota (m)',
    more: 'Más controles',
    zoomIn: 'Acercar', zoomInHint: 'Acercar (rueda)', zoomOut: 'Alejar', zoomOutHint: 'Alejar (rueda)',
    encounters: '{count encuentro|encuentros}', markers: '{count marca|marcas}',
    lastMinutes: 'últimos {minutes} min',
    lastSeconds: 'últimos {seconds} s',
    valueReplay: '{time}, {done} de {all}, {state}',
    valueLive: 'en vivo',
    valueMoment: '{time}, elegido para reproducir desde ahí',
    replayMission: 'Reproducir {mission}',
    replayFrom: 'Reproducir desde {time}', replayAny: 'Reproducir desde {time} …',
    chooseReplay: 'Reproducciones',
    startAgain: 'Iniciar de nuevo',
    starting: 'La reproducción se inicia.',
    counting: 'se cuentan los eventos …',
    noDensity: 'No se pueden mostrar los eventos: {reason}',
    tipEncounter: '{pair} · mínimo {distance}',
    flag: 'Marca {note}, {time}',
    markTitle: 'Marcar este momento', markDelete: 'Eliminar la marca {note}', markNote: '¿Qué ocurre aquí?', markSave: 'Añadir la marca', cancel: 'Cancelar',
  },

  // ------------------------------------------------------------------------------------------------------------------

  analyses: {
    title: 'Análisis',
    live: 'Resultados en vivo de los análisis.', replay: 'Resultados de los análisis en la reproducción de {mission}.', noAnalytics: 'Esta reproducción se inició sin análisis. Se muestran los resultados en vivo del tiempo de la grabación.',
    period: 'Período', hours: 'últimas {hours} h', quarter: 'últimos 15 min', mission: 'toda la misión',
    averages: 'Medias por parcela', encounters: 'Encuentros', presence: 'Presencia en parcelas',
    chart: 'Gráfico', table: 'Tabla',
    since: 'El tema tiene registros desde {time}; los anteriores se han eliminado.',
    failed: 'Esto no se pudo leer: {reason}', retry: 'Probar de nuevo',
    noAverages: 'Sin medias en este período', noAveragesHint: 'Las medias se calculan por ventana con los termómetros dentro de las parcelas.',
    noEncounters: 'Sin encuentros en este período', noEncountersHint: 'Un encuentro empieza cuando dos dispositivos se acercan más que el umbral.',
    noPresence: 'Ningún dispositivo estuvo en una parcela en este período', noPresenceHint: 'Una estancia empieza cuando un dispositivo entra en una parcela.',
    window: 'Ventana', from: 'Desde', to: 'Hasta', field: 'Parcela', mean: 'Media', plain: 'Media simple', devices: 'Dispositivos', suspects: 'Sospechosos', quality: 'Calidad', none: 'ninguno',
    qualities: { robust: 'robusta', unverified: 'sin verificar' },
    suspectMark: 'Triángulo: un dispositivo era sospechoso en esta ventana', hide: 'Mostrar u ocultar {field}',
    when: 'Cuándo', pair: 'Dispositivos', closest: 'Mínimo', duration: 'Duración', phase: 'Fase', sort: 'Ordenar por {column}',
    phases: { started: 'en curso', ongoing: 'en curso', ended: 'terminado', crossed: 'cruzado' },
    toMoment: 'Al momento', toMomentOf: 'Al momento de {pair} a las {time}',
    noRecording: 'sin grabar', more: 'Se muestran {shown} de {count}: mostrar más',
    stay: '{device} en {field}, de {from} a {to}', stillIn: 'sigue allí', device: 'Dispositivo', entered: 'Entró', left: 'Salió', stayed: 'Estancia',
    at: '{value} a las {time}', chartLabel: 'Medias por parcela a lo largo del tiempo; la tabla contiene los mismos números',
  },

  // ------------------------------------------------------------------------------------------------------------------

  history: {
    title: 'Historial', of: 'Historial de {name}', live: 'Lo que las misiones han grabado de un dispositivo.', replay: 'Lo que se grabó de un dispositivo en la misión {mission}.',
    device: 'Dispositivo', choose: 'Elija un dispositivo …', attribute: 'Atributo', second: 'Al lado', alone: 'nada',
    hour: 'última hora', days: 'últimos {days} d', own: 'De … a', show: 'Mostrar',
    threshold: 'Umbral', csv: 'CSV', png: 'PNG',
    chart: '{label} de {device} del {from} al {to}: mínimo {min}, máximo {max}, último {now}; la tabla tiene los mismos números',
    noDevice: 'Ningún dispositivo elegido', noDeviceHint: 'Elija uno arriba, o el signo de gráfico de su tarjeta.',
    noAttribute: 'Ningún número ni texto de este dispositivo', noAttributeHint: 'Ahora no envía ninguno. Elija otro dispositivo.',
    none: 'Ningún valor en este período', noneHint: 'Ninguna misión lo ha grabado. Un período más largo puede tener alguno.',
    other: 'Ni número ni texto', otherHint: 'Aquí se muestran números, sí o no, y textos. La vista de temas muestra valores de otras clases.',
    since: 'Guardado desde {time}, o no leído más atrás.', notStored: 'Nada de este período está guardado.', thinned: '{values} valores; de cada {part} se muestran el mínimo y el máximo.', skipped: '{count valor omitido|valores omitidos}: no son números, o tienen otra unidad.',
    pictures: 'Imágenes', allPictures: 'Imágenes de todas las cámaras', picture: 'Imagen', pictureCount: '{count imagen|imágenes}', pictureAt: '{name}, {time} · {number} de {count}', previous: 'Imagen anterior', next: 'Imagen siguiente',
    noPictures: 'Ninguna imagen en este período', noPicturesHint: 'Una imagen aparece aquí cuando una cámara la ha enviado y está guardada.',
    around: 'Imágenes', aroundOf: 'Imágenes alrededor de {pair} a las {time}',
  },

  // ------------------------------------------------------------------------------------------------------------------

  report: {
    title: 'Informe de {mission}', reading: 'Se lee el informe …', none: 'Todavía no hay nada que informar', noneHint: 'La misión no ha empezado, o no hay nada guardado de ella.', toMission: 'A la misión', again: 'Leer de nuevo', print: 'Imprimir o guardar como PDF',
    time: 'Tiempo', length: 'Duración', running: 'sigue en marcha', ofFields: '{share} de {hectares}', map: 'Parcelas', mapLabel: 'Mapa de las parcelas con lo trabajado. {fields}',
    runs: 'Ejecuciones', countRuns: '{count ejecución|ejecuciones}', late: 'Informes tarde', lateHint: 'El análisis encontró tarde sus informes: su reloj o su conexión van atrasados.',
    coverages: 'Superficie trabajada', encounters: 'Encuentros', averages: 'Temperaturas medias', alarms: 'Alarmas', markers: 'Notas', devices: 'Dispositivos',
    no: { coverages: 'No se conoce superficie trabajada de ese tiempo.', encounters: 'No se conocen encuentros de ese tiempo.', averages: 'No se conocen medias de ese tiempo.', alarms: 'No se conocen alarmas de ese tiempo.', markers: 'Sin notas.', devices: 'No se conocen dispositivos.' },
    alarmsRetained: 'Las alarmas se conocen hasta un día después de cerrarse.', more: 'Se muestran {shown} de {count}. El CSV contiene todo.', made: 'Hecho el {time} ({zone}) por Furrow.',
    field: 'Parcela', hectares: 'Trabajado', fieldHectares: 'Superficie', share: 'Parte', overlap: 'Trabajado de nuevo', gaps: 'Huecos', from: 'Desde', to: 'Hasta', mean: 'Media', min: 'Mínima', max: 'Máxima', windows: 'Ventanas', suspects: 'Sospechosos',
    when: 'Cuándo', severity: 'Gravedad', alarm: 'Alarma', times: 'Veces', open: 'Abierta durante', stillOpen: 'sigue abierta', note: 'Nota', author: 'Quién', device: 'Dispositivo', id: 'Identificador', type: 'Tipo', state: 'Estado',
  },

  // ------------------------------------------------------------------------------------------------------------------

  platform: {
    well: 'Todo funciona', wrong: 'Requiere atención', partDown: '{part}: {state}. {detail}', behind: '{group} va {lag registro|registros} por detrás', hasLetters: '{count registro no se pudo procesar y se apartó|registros no se pudieron procesar y se apartaron} como mensajes fallidos',
    parts: 'Partes', partNames: { api: 'API REST', iotAgent: 'IoT Agent', kafka: 'Kafka' }, states: { up: 'en marcha', down: 'caída', dead: 'muerta' },
    lag: 'Retraso', lagHint: 'Registros que un grupo de consumidores todavía no ha confirmado; los trabajos confirman con cada checkpoint.', noGroups: 'Ningún grupo de consumidores ha confirmado nada todavía.', ofReplays: '{count grupo|grupos} de reproducciones sin retraso',
    letters: 'Mensajes fallidos', noLetters: 'Ninguno en {count tema|temas}', lettersHint: 'Sus cabeceras describen el error y su lugar. Cuando esté corregido, vuelva a enviarlos:', lettersCommand: 'Órdenes que reenvían los mensajes fallidos', notKnown: 'Desconocido mientras no responda.',
    hops: 'Cuánto tarda un informe', hop: 'Tramo', axis: 'En un mismo eje', samples: '{count informe|informes} del último minuto', hopsWait: 'A la espera de informes …',
    hopNames: { device: 'Del dispositivo a Kafka', source: 'De Kafka al dominio', page: 'Del dominio a esta página', all: 'En total' },
    hopsHint: 'Según las horas de las cabeceras: cuándo midió el dispositivo, cuándo recibió la fuente NGSI el informe, cuándo lo encaminó ingest y cuándo lo recibió esta página. La parte clara es la mitad de los informes, las tenues son 95 y 99 de cada 100. Los relojes que difieren aparecen como retraso.',
  },
};
