"""WebSocket servers of a few lines, behaving or not, for the tests of the client and of the node."""
import base64
import hashlib
import json
import socket
import struct
import threading

HELLO = json.dumps({"name": "peer", "version": "2.23.0", "self": "vessels.urn:peer", "roles": ["master"]})


def frame(payload, opcode=1):
    data = payload.encode() if isinstance(payload, str) else payload
    size = len(data)
    head = bytes([size]) if size < 126 else struct.pack(">BH", 126, size) if size < 65536 else struct.pack(">BQ", 127, size)
    return bytes([0x80 | opcode]) + head + data


def upgrade(connection):
    """The server's half of the WebSocket handshake (RFC 6455, 4.2.2); the request's lines."""
    request = b""
    while b"\r\n\r\n" not in request:
        chunk = connection.recv(4096)
        if not chunk:
            return []
        request += chunk
    lines = request.decode().split("\r\n")
    key = next(line.split(": ")[1] for line in lines if line.lower().startswith("sec-websocket-key"))
    accept = base64.b64encode(hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()).decode()
    connection.sendall(("HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                        f"Sec-WebSocket-Accept: {accept}\r\n\r\n").encode())
    return lines


class Peer:
    """Serves every connection with the present behaviour, a function of the connection."""

    def __init__(self, behaviour):
        self.behaviour = behaviour
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        self.closing = threading.Event()
        self.connections = 0
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def serve(self):
        while not self.closing.is_set():
            try:
                connection, _ = self.listener.accept()
            except OSError:
                return
            self.connections += 1
            threading.Thread(target=self.one, args=(connection,), daemon=True).start()

    def one(self, connection):
        connection.settimeout(20.0)
        with connection:
            try:
                self.behaviour(connection)
            except OSError:
                pass  # the client has left

    def close(self):
        self.closing.set()
        self.listener.close()


def frames_of(connection):
    """The client's texts (masked frames, a long one in several: RFC 6455, 5.3 and 5.4); answers pings."""
    buffer = b""
    text = b""

    def need(count):
        nonlocal buffer
        while len(buffer) < count:
            chunk = connection.recv(65536)
            if not chunk:
                raise OSError("closed")
            buffer += chunk
        taken, buffer = buffer[:count], buffer[count:]
        return taken
    while True:
        first, second = need(2)
        size = second & 127
        size = struct.unpack(">H", need(2))[0] if size == 126 else struct.unpack(">Q", need(8))[0] if size == 127 else size
        mask, data = need(4), need(size)
        payload = bytes(byte ^ mask[i % 4] for i, byte in enumerate(data))
        if first & 15 == 9:
            connection.sendall(frame(payload, 10))
        elif first & 15 in (0, 1):
            text += payload
            if first & 128:
                yield text.decode()
                text = b""


def echo(connection):
    """A server in small: what is sent comes back."""
    upgrade(connection)
    connection.sendall(frame(HELLO))
    for text in frames_of(connection):
        if "values" in text:
            connection.sendall(frame(text))
